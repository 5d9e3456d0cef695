#include "morph/alignment/coarse.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "morph/alignment/places.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/index.h"
#include "morph/parameterization/decimation.h"
#include "morph/parameterization/fill.h"
#include "morph/parameterization/half_edges.h"

namespace automorph {

namespace {

using Eigen::Matrix3d;
using Eigen::RowVector3d;

constexpr double kStiff =
    1e-3;  // share of a plain shift in the affine motions: flat fans have no other answer

/// The affine part A_k of the motion about each vertex: the least squares fit to its edges and, with the size
/// of its edges, its normal.
std::vector<Matrix3d> affine_motions(const Mesh& rest, const Points& moved) {
    const auto n = at(rest.vertex_count());
    std::vector<Matrix3d> squares(n, Matrix3d::Zero()), products(n, Matrix3d::Zero());
    std::vector<double> moved_squares(n, 0.0);
    const auto add = [&](int v, const RowVector3d& before, const RowVector3d& after) {
        squares[at(v)] += before.transpose() * before;
        products[at(v)] += before.transpose() * after;
        moved_squares[at(v)] += after.squaredNorm();
    };
    for (int f = 0; f < rest.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int v = rest.F(f, k);
            for (const int w : {rest.F(f, (k + 1) % 3), rest.F(f, (k + 2) % 3)})
                add(v, rest.V.row(w) - rest.V.row(v), moved.row(w) - moved.row(v));
        }
    }
    const Points normals = vertex_normals(rest), moved_normals = vertex_normals({moved, rest.F});
    std::vector<Matrix3d> motions(n);
    for (int v = 0; v < rest.vertex_count(); ++v) {
        // Across the surface as much weight as in a direction along it, and the same growth.
        add(v, std::sqrt(0.5 * squares[at(v)].trace()) * normals.row(v),
            std::sqrt(0.5 * moved_squares[at(v)]) * moved_normals.row(v));
        const Matrix3d shift = kStiff * squares[at(v)].trace() * Matrix3d::Identity();
        motions[at(v)] = shift.isZero(0.0)
                             ? Matrix3d::Identity().eval()
                             : (squares[at(v)] + shift).ldlt().solve(products[at(v)] + shift).eval();
    }
    return motions;
}

}  // namespace

CoarseMesh coarse_mesh(const Mesh& mesh, const std::vector<std::vector<int>>& loops, int vertices) {
    Mesh closed = loops.empty() ? mesh : fill_openings(mesh, loops).mesh;
    const double area = triangle_areas(mesh).sum();
    const Points V =
        (closed.V.rowwise() - closed.V.colwise().mean()) * std::sqrt(4.0 * std::numbers::pi / area);
    std::vector<char> fixed(loops.empty() ? 0 : at(closed.vertex_count()), 0);
    for (const std::vector<int>& loop : loops) {
        for (const int v : loop) fixed[at(v)] = 1;
    }
    for (int v = mesh.vertex_count(); v < closed.vertex_count(); ++v) fixed[at(v)] = 1;
    HalfEdges edges = half_edges(closed.F, closed.vertex_count());
    const std::vector<int> collapses = decimate(edges, V, fixed, vertices);

    std::vector<char> gone(at(closed.vertex_count()), 0), removed(at(closed.triangle_count()), 0);
    for (const int h : collapses) {
        gone[at(edges.origin[at(h)])] = 1;
        removed[at(HalfEdges::triangle(h))] = removed[at(HalfEdges::triangle(edges.twin(h)))] = 1;
    }
    CoarseMesh coarse;
    std::vector<int> number(at(mesh.vertex_count()), -1);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (gone[at(v)]) continue;
        number[at(v)] = static_cast<int>(coarse.vertex.size());
        coarse.vertex.push_back(v);
    }
    coarse.mesh.V = mesh.V(coarse.vertex, Eigen::all);
    coarse.mesh.F.resize(mesh.triangle_count(), 3);
    int kept = 0;
    // Triangles of the fillings come last and are left out.
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        if (removed[at(f)]) continue;
        for (int k = 0; k < 3; ++k) coarse.mesh.F(kept, k) = number[at(edges.origin[at(4 * f + k)])];
        ++kept;
    }
    coarse.mesh.F.conservativeResize(kept, 3);
    for (const std::vector<int>& loop : loops) {
        coarse.loops.emplace_back();
        for (const int v : loop) coarse.loops.back().push_back(number[at(v)]);
    }
    return coarse;
}

Points carried(const Mesh& rest, const Points& moved, const Points& points, const Points& normals) {
    const std::vector<Matrix3d> motions = affine_motions(rest, moved);
    const std::vector<SurfacePlace> places = places_on(rest, points, normals);
    Points result = Points::Zero(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const SurfacePlace& place = places[static_cast<std::size_t>(i)];
        for (std::size_t k = 0; k < 3; ++k) {
            const int v = place.corners[k];
            result.row(i) += place.weights[static_cast<Eigen::Index>(k)] *
                             (moved.row(v) + (points.row(i) - rest.V.row(v)) * motions[at(v)]);
        }
    }
    return result;
}

}  // namespace automorph
