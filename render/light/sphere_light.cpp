#include "render/light/sphere_light.h"

#include <algorithm>
#include <cmath>

#include "render/math/angle.h"
#include "render/math/disk.h"

namespace automorph::render {
namespace {

// One minus the cosine of half the angle under which the sphere is seen, without cancellation.
float cap_height(float radius, float distance2) {
    const float sine2 = radius * radius / distance2;
    return sine2 / (1.0f + std::sqrt(1.0f - sine2));
}

}  // namespace

std::optional<LightSample> sample(const SphereLight& light, const Vec3& point, float u, float v) {
    const Vec3 to_center = light.center - point;
    const float distance2 = to_center.squaredNorm();
    if (!(distance2 > light.radius * light.radius && light.radius > 0.0f)) return std::nullopt;
    const float distance = std::sqrt(distance2), cap = cap_height(light.radius, distance2);
    // The disk's squared radius is uniform, as the cap's height is.
    const Eigen::Vector2f disk = sample_disk(u, v);
    const float height = disk.squaredNorm() * cap;
    const Eigen::Vector2f side = std::sqrt(cap * (2.0f - height)) * disk;
    const Vec3 wi = Frame(to_center / distance).to_world({side.x(), side.y(), 1.0f - height});
    const float chord2 = light.radius * light.radius - distance2 * side.squaredNorm();
    const float to_sphere = distance * (1.0f - height) - std::sqrt(std::max(0.0f, chord2));
    return LightSample{to_sphere * wi, wi, light.radiance, 1.0f / (2.0f * kPi * cap)};
}

std::optional<LightHit> intersect(const SphereLight& light, const Vec3& origin, const Vec3& direction) {
    const Vec3 to_center = light.center - origin;
    const float distance2 = to_center.squaredNorm(), along = to_center.dot(direction);
    if (!(along > 0.0f && distance2 > light.radius * light.radius)) return std::nullopt;
    const float chord2 = light.radius * light.radius - (to_center - along * direction).squaredNorm();
    if (!(chord2 > 0.0f)) return std::nullopt;
    return LightHit{along - std::sqrt(chord2), 1.0f / (2.0f * kPi * cap_height(light.radius, distance2))};
}

// Where the horizon cuts the sphere: the integral of the cosine over a spherical cap above a plane
// [Snyder96].
Color irradiance(const SphereLight& light, const Vec3& point, const Vec3& normal) {
    const Eigen::Vector3d to_center = (light.center - point).cast<double>();
    const double distance2 = to_center.squaredNorm();
    const double sine2 = static_cast<double>(light.radius) * static_cast<double>(light.radius) / distance2;
    if (!(sine2 < 1.0)) return Color::Zero();
    const double cosine = to_center.dot(normal.cast<double>()) / std::sqrt(distance2);
    constexpr double kHalfTurn = 3.14159265358979324;
    double integral = kHalfTurn * sine2 * std::max(0.0, cosine);
    if (cosine * cosine < sine2) {
        const double tilt = std::sqrt(1.0 - cosine * cosine), x = std::sqrt(1.0 / sine2 - 1.0);
        const double y = -x * cosine / tilt, rest = std::sqrt(std::max(0.0, 1.0 - y * y));
        integral = (cosine * angle_of(rest, y) - x * tilt * rest) * sine2 + angle_of(tilt * rest, x);
    }
    return light.radiance * static_cast<float>(integral);
}

}  // namespace automorph::render
