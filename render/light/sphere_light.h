#pragma once

#include <optional>

#include "render/light/light.h"
#include "render/math/vec.h"

namespace automorph::render {

/// A sphere that radiates evenly outwards and is invisible from inside. It neither blocks nor reflects light.
struct SphereLight {
    Vec3 center{0.0f, 0.0f, 1.0f};
    float radius = 0.1f;
    Color radiance{1.0f, 1.0f, 1.0f};
    bool visible_to_camera = true;  ///< whether camera rays see it; scattered rays always do
};

/// Samples the directions that meet the sphere evenly by (u, v) in [0, 1)^2; empty inside the sphere.
std::optional<LightSample> sample(const SphereLight& light, const Vec3& point, float u, float v);

/// @pre `direction` is a unit vector
std::optional<LightHit> intersect(const SphereLight& light, const Vec3& origin, const Vec3& direction);

/// Irradiance that an unoccluded sphere gives a surface at `point` with unit normal `normal`, with the part
/// below the surface's horizon cut off.
Color irradiance(const SphereLight& light, const Vec3& point, const Vec3& normal);

}  // namespace automorph::render
