#pragma once

#include <cstdint>

#include "render/geometry/embree_scene.h"
#include "render/geometry/scene.h"
#include "render/math/ray.h"
#include "render/math/vec.h"

namespace automorph::render {

/// A place on a surface, seen from the side that a ray came from.
struct SurfacePoint {
    Vec3 position;
    Vec3 ray_origin;         ///< where scattered and shadow rays start
    Vec3 ray_origin_behind;  ///< where those start that pass through the surface
    Vec3 geometric_normal;   ///< unit, on the ray's side
    Vec3 shading_normal;     ///< unit, in the geometric normal's hemisphere
    Color base_color;
    bool front;  ///< whether the ray came to the side from which the triangle is counter-clockwise
};

/// Distance of a place on a triangle from the nearest of its edges, as seen along the ray: across it, scene
/// units.
float edge_distance(const TriangleMesh& mesh, std::uint32_t triangle, const Vec3& place, const Ray& ray);

/// Unit normal of the side from which the triangle is counter-clockwise; zero if it has no area.
Vec3 geometric_normal(const TriangleMesh& mesh, std::uint32_t triangle);

/// The place where a ray met a triangle.
///
/// Computed from the triangle and the ray alone. Embree's own distance and barycentric coordinates come from
/// an approximate reciprocal whose last bits depend on the processor's maker.
SurfacePoint surface_point(const Scene& scene, const Hit& hit, const Ray& ray);

}  // namespace automorph::render
