#pragma once

#include <optional>

#include "render/geometry/embree_scene.h"
#include "render/geometry/scene.h"
#include "render/math/vec.h"

namespace automorph::render {

/// A place on a surface, seen from the side that a ray came from.
struct SurfacePoint {
    Vec3 position;
    Vec3 ray_origin;        ///< where scattered and shadow rays start
    Vec3 geometric_normal;  ///< unit, on the ray's side
    Vec3 shading_normal;    ///< unit, in the geometric normal's hemisphere
    const Material* material;
};

/// The place where a ray met a triangle.
///
/// Computed from the triangle and the ray alone. Embree's own distance and barycentric coordinates come from
/// an approximate reciprocal whose last bits depend on the processor's maker.
SurfacePoint surface_point(const Scene& scene, const Hit& hit, const Vec3& origin, const Vec3& direction);

}  // namespace automorph::render
