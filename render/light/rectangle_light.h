#pragma once

#include <optional>

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

/// A direction towards a light, sampled with density `pdf`.
struct LightSample {
    Vec3 to_light;   ///< from the lit point to the sampled point of the light, not normalised
    Vec3 wi;         ///< to_light normalised
    Color radiance;  ///< arriving at the lit point if nothing is between
    float pdf;       ///< per solid angle at the lit point
};

/// Samples the rectangle's area evenly by (u, v) in [0, 1)^2; empty when the point is behind the light.
std::optional<LightSample> sample(const RectangleLight& light, const Vec3& point, float u, float v);

/// Where a ray meets the radiating side.
struct LightHit {
    float distance;  ///< in lengths of the direction
    float pdf;       ///< density of sample() for this direction, per solid angle
};

/// @pre `direction` is a unit vector
std::optional<LightHit> intersect(const RectangleLight& light, const Vec3& origin, const Vec3& direction);

/// Irradiance that an unoccluded rectangle gives a surface at `point` with unit normal `normal`: Lambert's
/// polygon formula, with the part below the surface's horizon cut off.
Color irradiance(const RectangleLight& light, const Vec3& point, const Vec3& normal);

}  // namespace automorph::render
