#include "render/light/rectangle_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/math/angle.h"

namespace automorph::render {
namespace {

using Vec3d = Eigen::Vector3d;

// Integral of cosine over the polygon's solid angle [Lambert 1760]: half the sum over the edges of the angle
// they subtend times the normal's part along the edge's plane. Corners are relative to the lit point.
double cosine_integral(const std::array<Vec3d, 5>& corners, std::size_t count, const Vec3d& normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d& a = corners[i];
        const Vec3d& b = corners[(i + 1) % count];
        const Vec3d axis = cross(a, b);
        const double sine = axis.norm();
        if (sine > 0.0) sum += angle_of(sine, a.dot(b)) * axis.dot(normal) / sine;
    }
    return 0.5 * sum;
}

// The same for the whole rectangle, its four edges at once.
double cosine_integral(const std::array<Vec3d, 4>& corners, const Vec3d& normal) {
    using Array = Eigen::Array4d;
    const Array ax(corners[0].x(), corners[1].x(), corners[2].x(), corners[3].x()),
        ay(corners[0].y(), corners[1].y(), corners[2].y(), corners[3].y()),
        az(corners[0].z(), corners[1].z(), corners[2].z(), corners[3].z());
    const Array bx(ax[1], ax[2], ax[3], ax[0]), by(ay[1], ay[2], ay[3], ay[0]),
        bz(az[1], az[2], az[3], az[0]);
    const Array x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
    const Array sine = (x * x + y * y + z * z).sqrt(), cosine = ax * bx + ay * by + az * bz;
    const Array along = x * normal.x() + y * normal.y() + z * normal.z();
    return 0.5 * (sine > 0.0).select(angle_of(sine, cosine) * along / sine, 0.0).sum();
}

// The part of the polygon above the plane through the origin with the given normal [Sutherland74].
std::size_t clip(const std::array<Vec3d, 4>& polygon, const Vec3d& normal, std::array<Vec3d, 5>& clipped) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& a = polygon[i];
        const Vec3d& b = polygon[(i + 1) % polygon.size()];
        const double above_a = a.dot(normal), above_b = b.dot(normal);
        if (above_a >= 0.0) clipped[count++] = a;
        if ((above_a >= 0.0) != (above_b >= 0.0))
            clipped[count++] = a + above_a / (above_a - above_b) * (b - a);
    }
    return count;
}

}  // namespace

RectangleLight square_light(const Vec3& center, const Vec3& target, float side, const Color& radiance) {
    const Vec3 normal = (target - center).normalized();
    Vec3 u = cross(Vec3(0.0f, 0.0f, 1.0f), normal);
    u = u.squaredNorm() > 1e-12f ? Vec3(u.normalized()) : Vec3(1.0f, 0.0f, 0.0f);  // straight up or down
    RectangleLight light;
    light.center = center;
    light.edge_u = side * u;
    light.edge_v = side * cross(normal, u);
    light.radiance = radiance;
    return light;
}

Color irradiance(const RectangleLight& light, const Vec3& point, const Vec3& normal) {
    const Vec3d center = (light.center - point).cast<double>();
    const Vec3d u = 0.5 * light.edge_u.cast<double>(), v = 0.5 * light.edge_v.cast<double>();
    if (!(center.dot(cross(u, v)) < 0.0)) return Color::Zero();
    // Clockwise seen from the lit side, so that the integral is positive where the normal faces the light.
    const std::array<Vec3d, 4> corners{center - u - v, center - u + v, center + u + v, center + u - v};
    const Vec3d n = normal.cast<double>();
    if (std::all_of(corners.begin(), corners.end(),
                    [&](const Vec3d& corner) { return corner.dot(n) >= 0.0; }))
        return light.radiance * static_cast<float>(cosine_integral(corners, n));
    std::array<Vec3d, 5> clipped;
    const std::size_t count = clip(corners, n, clipped);
    return light.radiance * static_cast<float>(cosine_integral(clipped, count, n));
}

}  // namespace automorph::render
