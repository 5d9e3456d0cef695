#pragma once

#include <cmath>
#include <optional>

#include "render/light/light.h"
#include "render/math/vec.h"

namespace automorph::render {

/// A rectangle that radiates evenly to the side of edge_u x edge_v and is invisible from behind. It neither
/// blocks nor reflects light.
struct RectangleLight {
    Vec3 center{0.0f, 0.0f, 1.0f};
    Vec3 edge_u{1.0f, 0.0f, 0.0f};  ///< whole edges, scene units; orthogonal
    Vec3 edge_v{0.0f, -1.0f, 0.0f};
    Color radiance{1.0f, 1.0f, 1.0f};
    bool visible_to_camera = true;  ///< whether camera rays see it; scattered rays always do
};

/// A square light of side `side` around `center`, facing `target`, one pair of edges horizontal (Z up).
RectangleLight square_light(const Vec3& center, const Vec3& target, float side, const Color& radiance);

/// What of a rectangle does not depend on the lit point.
struct RectangleShape {
    explicit RectangleShape(const RectangleLight& light)
        : area_normal(cross(light.edge_u, light.edge_v)),
          u2(light.edge_u.squaredNorm()),
          v2(light.edge_v.squaredNorm()) {}

    Vec3 area_normal;  ///< to the radiating side, as long as the area is large
    float u2, v2;      ///< squared edges
};

/// Samples the rectangle's area evenly by (u, v) in [0, 1)^2; empty when the point is behind the light.
/// @pre `shape` is the light's
inline std::optional<LightSample> sample(const RectangleLight& light, const RectangleShape& shape,
                                         const Vec3& point, float u, float v) {
    const Vec3 to_light = light.center + (u - 0.5f) * light.edge_u + (v - 0.5f) * light.edge_v - point;
    const float distance2 = to_light.squaredNorm();
    const float facing = -to_light.dot(shape.area_normal);  // area * distance * cosine at the light
    if (!(facing > 0.0f)) return std::nullopt;
    const float distance = std::sqrt(distance2);
    return LightSample{to_light, 1.0f / distance * to_light, light.radiance, distance2 * distance / facing};
}
inline std::optional<LightSample> sample(const RectangleLight& light, const Vec3& point, float u, float v) {
    return sample(light, RectangleShape(light), point, u, v);
}

/// @pre `direction` is a unit vector, `shape` is the light's
inline std::optional<LightHit> intersect(const RectangleLight& light, const RectangleShape& shape,
                                         const Vec3& origin, const Vec3& direction) {
    const float facing = -direction.dot(shape.area_normal);
    if (!(facing > 0.0f)) return std::nullopt;
    const Vec3 to_center = light.center - origin;
    const float distance = -to_center.dot(shape.area_normal) / facing;
    if (!(distance > 0.0f)) return std::nullopt;
    const Vec3 place = distance * direction - to_center;
    if (2.0f * std::abs(place.dot(light.edge_u)) > shape.u2) return std::nullopt;
    if (2.0f * std::abs(place.dot(light.edge_v)) > shape.v2) return std::nullopt;
    return LightHit{distance, distance * distance / facing};
}
inline std::optional<LightHit> intersect(const RectangleLight& light, const Vec3& origin,
                                         const Vec3& direction) {
    return intersect(light, RectangleShape(light), origin, direction);
}

/// Irradiance that an unoccluded rectangle gives a surface at `point` with unit normal `normal`: Lambert's
/// polygon formula, with the part below the surface's horizon cut off.
Color irradiance(const RectangleLight& light, const Vec3& point, const Vec3& normal);

}  // namespace automorph::render
