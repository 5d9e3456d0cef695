#pragma once

#include <Eigen/Core>
#include <limits>

namespace automorph::render {

using Vec3 = Eigen::Vector3f;  ///< a point or direction in world space
using Color = Eigen::Array3f;  ///< linear Rec.709/sRGB primaries; radiance in W/(sr m^2), or a reflectance

inline constexpr float kPi = 3.14159265358979324f;
inline constexpr float kInvPi = 0.318309886183790672f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Of linear Rec.709.
template <class Scalar>
double luminance(const Eigen::Array<Scalar, 3, 1>& c) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

/// Cross product (without the weight of <Eigen/Geometry>).
template <class Vector>
inline Vector cross(const Vector& a, const Vector& b) {
    return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

/// An orthonormal frame about the unit vector `normal`, its third axis [Duff17].
struct Frame {
    Vec3 tangent, bitangent, normal;

    explicit Frame(const Vec3& n) : normal(n) {
        const float sign = n.z() >= 0.0f ? 1.0f : -1.0f;
        const float a = -1.0f / (sign + n.z());
        const float b = n.x() * n.y() * a;
        tangent = {1.0f + sign * n.x() * n.x() * a, sign * b, -sign * n.x()};
        bitangent = {b, sign + n.y() * n.y() * a, -n.y()};
    }

    Vec3 to_world(const Vec3& local) const {
        return local.x() * tangent + local.y() * bitangent + local.z() * normal;
    }
    Vec3 to_local(const Vec3& world) const {
        return {world.dot(tangent), world.dot(bitangent), world.dot(normal)};
    }
};

}  // namespace automorph::render
