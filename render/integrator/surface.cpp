#include "render/integrator/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace automorph::render {
namespace {

// Barycentric coordinates of the ray's point in the triangle [Moeller97], forced into it: rounding must not
// put the point beside a neighbouring triangle.
std::array<float, 3> barycentric(const std::array<Vec3, 3>& p, const Vec3& origin, const Vec3& direction) {
    const Vec3 e1 = p[1] - p[0], e2 = p[2] - p[0];
    const Vec3 t = origin - p[0];
    const Vec3 a = cross(direction, e2), b = cross(t, e1);
    const float determinant = e1.dot(a);
    if (determinant == 0.0f) return {1.0f, 0.0f, 0.0f};
    const float inverse = 1.0f / determinant;
    const float v = std::clamp(t.dot(a) * inverse, 0.0f, 1.0f);
    const float w = std::clamp(direction.dot(b) * inverse, 0.0f, 1.0f - v);
    return {1.0f - v - w, v, w};
}

}  // namespace

Vec3 geometric_normal(const TriangleMesh& mesh, std::uint32_t triangle) {
    const std::array<Vec3, 3> p = mesh.corners(triangle, 0.0f);
    const Vec3 area_normal = cross(Vec3(p[1] - p[0]), Vec3(p[2] - p[0]));
    const float length2 = area_normal.squaredNorm();
    return length2 > 0.0f ? Vec3(area_normal / std::sqrt(length2)) : Vec3::Zero();
}

float edge_distance(const TriangleMesh& mesh, std::uint32_t triangle, const Vec3& place, const Ray& ray) {
    const std::array<Vec3, 3> p = mesh.corners(triangle, ray.time);
    const auto across = [&](const Vec3& v) { return Vec3(v - v.dot(ray.direction) * ray.direction); };
    float least = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 edge = across(p[(k + 1) % 3] - p[k]), from = across(place - p[k]);
        const float length2 = edge.squaredNorm();
        if (length2 > 0.0f) least = std::min(least, cross(edge, from).squaredNorm() / length2);
    }
    return std::sqrt(least);
}

SurfacePoint surface_point(const Scene& scene, const Hit& hit, const Ray& ray) {
    const Vec3& direction = ray.direction;
    const TriangleMesh& mesh = scene.mesh(static_cast<int>(hit.mesh));
    const std::array<Vec3, 3> p = mesh.corners(hit.triangle, ray.time);
    const std::array<float, 3> b = barycentric(p, ray.origin, direction);

    SurfacePoint point;
    if (mesh.has_colors()) {
        const std::array<Vec3, 3> c = mesh.corner_colors(hit.triangle);
        point.base_color = b[0] * c[0].array() + b[1] * c[1].array() + b[2] * c[2].array();
    } else {
        point.base_color = scene.material(static_cast<int>(hit.mesh)).base_color;
    }
    point.position = b[0] * p[0] + b[1] * p[1] + b[2] * p[2];
    const Vec3 area_normal = cross(Vec3(p[1] - p[0]), Vec3(p[2] - p[0]));
    const float length2 = area_normal.squaredNorm();
    Vec3 ng = length2 > 0.0f ? Vec3(1.0f / std::sqrt(length2) * area_normal) : Vec3(-direction);
    const float side = ng.dot(direction) > 0.0f ? -1.0f : 1.0f;
    ng *= side;
    point.front = side > 0.0f;
    point.geometric_normal = ng;
    point.shading_normal = ng;

    Vec3 lifted = point.position;
    if (mesh.smooth()) {
        const std::array<Vec3, 3> n = mesh.corner_normals(hit.triangle, ray.time);
        const Vec3 sum = side * (b[0] * n[0] + b[1] * n[1] + b[2] * n[2]);
        const float sum2 = sum.squaredNorm();
        if (sum2 > 0.0f) {
            const Vec3 ns = sum / std::sqrt(sum2);
            // A normal that faces away would turn the surface black at its rim; the diffuse BSDF needs no
            // more than the right side.
            point.shading_normal = ns.dot(ng) > 0.0f ? ns : Vec3(ns - 2.0f * ns.dot(ng) * ng);
        }
        // Rays start at the tangent planes of the corners where these are above the triangle [Hanika21]: a
        // convex patch then does not cast the shadow of its flat triangles on its round shading.
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 nk = side * n[k];
            lifted -= b[k] * std::min(0.0f, (point.position - p[k]).dot(nk)) * nk;
        }
    }
    point.ray_origin = lifted + mesh.ray_offset() * ng;
    point.ray_origin_behind = point.position - mesh.ray_offset() * ng;
    return point;
}

}  // namespace automorph::render
