#include "morph/features/curvature.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

using Eigen::Vector3d;

/// Bound of cotangents in the heat flow, without unit: a needle's edge of no length is stiff, not infinitely
/// so.
constexpr double kLargestCotangent = 1e6;
/// Least area of a vertex in the heat flow, relative to that of the surface: it only keeps the matrix
/// regular.
constexpr double kLeastMass = 1e-15;

Vector3d position(const Mesh& mesh, int v) {
    return mesh.V.row(v);
}

double angle(const Vector3d& u, const Vector3d& v) {
    return std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Unit normal of each triangle, zero where it has no area (#F x 3).
Points triangle_normals(const Mesh& mesh) {
    Points normals(mesh.triangle_count(), 3);
    for (int f = 0; f < mesh.triangle_count(); ++f)
        normals.row(f) = doubled_area_vector(mesh.V, mesh.F, f).normalized();
    return normals;
}

/// The angle between the normals on either side of half-edge h; positive at a ridge.
double bend(const Points& normals, const HalfEdgeTable& half_edges, int h, const Vector3d& edge) {
    const Vector3d left = normals.row(HalfEdgeTable::face(h)), right = normals.row(half_edges.face_across(h));
    return std::atan2(left.cross(right).dot(edge.normalized()), left.dot(right));
}

/// M + time L: M the areas of the vertices, L the negated cotangent Laplacian with its negative weights left
/// out, so that heat flow makes no new extrema, and the others bounded. Symmetric, positive definite.
Eigen::SparseMatrix<double> heat_flow(const Mesh& mesh, const Eigen::VectorXd& mass, double time) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(mesh.vertex_count() + 12 * mesh.triangle_count()));
    for (int v = 0; v < mesh.vertex_count(); ++v) entries.emplace_back(v, v, mass[v]);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int i = mesh.F(f, k), j = mesh.F(f, (k + 1) % 3), apex = mesh.F(f, (k + 2) % 3);
            const Vector3d u = position(mesh, i) - position(mesh, apex),
                           v = position(mesh, j) - position(mesh, apex);
            const double along = u.dot(v), across = u.cross(v).norm();
            if (!(along > 0.0)) continue;
            const double weight =
                0.5 * time * (along < kLargestCotangent * across ? along / across : kLargestCotangent);
            entries.insert(entries.end(), {{i, i, weight}, {j, j, weight}, {i, j, -weight}, {j, i, -weight}});
        }
    }
    Eigen::SparseMatrix<double> matrix(mesh.vertex_count(), mesh.vertex_count());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

}  // namespace

Curvature curvature(const Mesh& mesh, const HalfEdgeTable& half_edges) {
    const int n = mesh.vertex_count();
    const double area = triangle_areas(mesh).sum();
    const Eigen::VectorXd areas = vertex_areas(mesh);  // A_i / 3
    const Points normals = triangle_normals(mesh);
    Curvature result;
    result.gaussian = Eigen::VectorXd::Constant(n, 2.0 * std::numbers::pi);
    result.mean = Eigen::VectorXd::Zero(n);
    result.defined.resize(static_cast<std::size_t>(n));
    for (int v = 0; v < n; ++v) result.defined[static_cast<std::size_t>(v)] = areas[v] > 0.0;
    for (int h = 0; h < half_edges.count(); ++h) {
        const int from = half_edges.from(h), to = half_edges.to(h), apex = half_edges.apex(h);
        const Vector3d edge = position(mesh, to) - position(mesh, from);
        result.gaussian[from] -= angle(edge, position(mesh, apex) - position(mesh, from));
        if (half_edges.opposite(h) < 0) {
            for (const int v : {from, to}) result.defined[static_cast<std::size_t>(v)] = 0;
        } else {
            result.mean[from] += 0.25 * edge.norm() * bend(normals, half_edges, h, edge);
        }
    }
    for (int v = 0; v < n; ++v) {
        result.gaussian[v] = result[v] ? result.gaussian[v] / areas[v] * area : 0.0;
        result.mean[v] = result[v] ? result.mean[v] / areas[v] * std::sqrt(area) : 0.0;
    }
    return result;
}

Curvature smoothed(const Curvature& curvature, const Mesh& mesh, double length) {
    // (M + t L) u' = M u; heat spreads with variance 2 t along every line. What is not defined takes no part:
    // its mass is spread too, and the result divided by the share that was there.
    const double area = triangle_areas(mesh).sum();
    if (!(area > 0.0)) return curvature;
    const Eigen::VectorXd areas = vertex_areas(mesh);
    // Vertices without triangles or area: the matrix stays regular.
    const Eigen::VectorXd mass = areas.cwiseMax(kLeastMass * area);
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(
        heat_flow(mesh, mass, 0.5 * length * length * area));
    if (solver.info() != Eigen::Success)
        throw SolverFailure("features: the heat flow could not be factorised");

    const auto n = static_cast<Eigen::Index>(curvature.defined.size());
    Eigen::VectorXd share(n);
    for (Eigen::Index v = 0; v < n; ++v)
        share[v] = curvature.defined[static_cast<std::size_t>(v)] ? areas[v] : 0.0;
    Curvature result = curvature;
    const Eigen::VectorXd part = solver.solve(share);
    const Eigen::VectorXd gaussian = solver.solve(share.cwiseProduct(curvature.gaussian)),
                          mean = solver.solve(share.cwiseProduct(curvature.mean));
    for (Eigen::Index v = 0; v < n; ++v) {
        char& defined = result.defined[static_cast<std::size_t>(v)];
        defined = defined && part[v] > 0.0;
        result.gaussian[v] = defined ? gaussian[v] / part[v] : 0.0;
        result.mean[v] = defined ? mean[v] / part[v] : 0.0;
    }
    return result;
}

}  // namespace automorph
