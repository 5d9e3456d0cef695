#include "morph/shapes/radial.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "morph/mesh/errors.h"
#include "morph/shapes/random.h"
#include "morph/shapes/remesh.h"

namespace automorph {

namespace {

constexpr int kSubdivisions = 4;  // 5120 triangles: fine enough for an arm of a twelve-armed star

Mesh icosahedron() {
    const double g = (1.0 + std::sqrt(5.0)) / 2.0;
    Mesh mesh;
    mesh.V.resize(12, 3);
    mesh.V << -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, g, 0, -1, g, 0,
        1, -g, 0, -1, -g, 0, 1;
    mesh.F.resize(20, 3);
    mesh.F << 0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1,
        8, 3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1;
    return mesh;
}

/// Every triangle becomes four.
Mesh subdivide(const Mesh& mesh) {
    Mesh fine;
    fine.V.resize(mesh.vertex_count() + 3 * mesh.triangle_count() / 2, 3);
    fine.V.topRows(mesh.vertex_count()) = mesh.V;
    fine.F.resize(4 * mesh.triangle_count(), 3);
    int count = mesh.vertex_count();
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
        const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), count);
        if (is_new) fine.V.row(count++) = 0.5 * (mesh.V.row(a) + mesh.V.row(b));
        return entry->second;
    };
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const int a = mesh.F(f, 0), b = mesh.F(f, 1), c = mesh.F(f, 2);
        const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.F.middleRows<4>(4 * f) << a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca;
    }
    return fine;
}

/// Where the ray leaves the surface.
Eigen::Vector3d meet(const ImplicitSurface& surface, const Eigen::Vector3d& direction, double radius) {
    constexpr int kBisections = 24;  // Newton's method does the rest
    if (!(surface(radius * direction).value > 0.0)) {
        throw SolverFailure(fmt::format("the surface reaches beyond radius {:g} along ({:g} {:g} {:g})",
                                        radius, direction.x(), direction.y(), direction.z()));
    }
    double inside = 0.0, outside = radius;
    for (int k = 0; k < kBisections; ++k) {
        const double middle = 0.5 * (inside + outside);
        (surface(middle * direction).value > 0.0 ? outside : inside) = middle;
    }
    if (inside == 0.0) throw SolverFailure("the surface does not enclose the origin");
    return inside * direction;
}

}  // namespace

Mesh radial_mesh(const ImplicitSurface& surface, double radius, std::uint64_t seed) {
    Mesh mesh = icosahedron();
    for (int k = 0; k < kSubdivisions; ++k) mesh = subdivide(mesh);
    Random random(seed);
    const Eigen::Matrix3d turn = Eigen::Quaterniond(random.in_ball<4>().normalized()).toRotationMatrix();
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::Vector3d direction = turn * mesh.V.row(v).transpose().normalized();
        mesh.V.row(v) = meet(surface, direction, radius).transpose();
    }
    return mesh;
}

Mesh radial_shape(const ImplicitSurface& surface, double radius, const ShapeOptions& options) {
    RemeshOptions remeshing;
    remeshing.triangles = options.triangles;
    remeshing.seed = options.seed;
    return posed(remesh(radial_mesh(surface, radius, options.seed), surface, remeshing), options);
}

Mesh posed(Mesh mesh, const ShapeOptions& options) {
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::Vector3d p = mesh.V.row(v).transpose();
        mesh.V.row(v) = (options.scale * (options.rotation * p) + options.translation).transpose();
    }
    return mesh;
}

}  // namespace automorph
