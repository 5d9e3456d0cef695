#include "morph/alignment/prior.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr double kLargestCotangent = 1e3;
constexpr double kSmallestMass = 1e-3;    // of the mean
constexpr int kHub = 200;                 // neighbours: a vertex with more bends freely
constexpr double kSmallestLength = 1e-3;  // of the mean border edge

/// sum over edges of w_ij |u_i - u_j|^2 as a matrix, from entries (i, j, w) with each edge once or more.
Matrix laplacian(int n, const std::vector<Eigen::Triplet<double>>& edges) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(4 * edges.size());
    for (const auto& e : edges) {
        entries.emplace_back(e.row(), e.col(), -e.value());
        entries.emplace_back(e.col(), e.row(), -e.value());
        entries.emplace_back(e.row(), e.row(), e.value());
        entries.emplace_back(e.col(), e.col(), e.value());
    }
    Matrix L(n, n);
    L.setFromTriplets(entries.begin(), entries.end());
    return L;
}

Matrix cotangent_laplacian(const Mesh& mesh) {
    std::vector<Eigen::Triplet<double>> edges;
    edges.reserve(static_cast<std::size_t>(3 * mesh.triangle_count()));
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int i = mesh.F(f, (k + 1) % 3), j = mesh.F(f, (k + 2) % 3);
            const Eigen::RowVector3d a = mesh.V.row(i) - mesh.V.row(mesh.F(f, k)),
                                     b = mesh.V.row(j) - mesh.V.row(mesh.F(f, k));
            const double sine = a.cross(b).norm(), cosine = a.dot(b);
            const double cotangent = sine * kLargestCotangent > std::abs(cosine)
                                         ? cosine / sine
                                         : std::copysign(kLargestCotangent, cosine);
            edges.emplace_back(std::min(i, j), std::max(i, j), 0.5 * cotangent);
        }
    }
    // One weight per edge, so that its sign can be judged.
    Matrix sums(mesh.vertex_count(), mesh.vertex_count());
    sums.setFromTriplets(edges.begin(), edges.end());
    edges.clear();
    for (int column = 0; column < sums.outerSize(); ++column) {
        for (Matrix::InnerIterator it(sums, column); it; ++it)
            edges.emplace_back(it.row(), it.col(), std::max(it.value(), 0.0));
    }
    return laplacian(mesh.vertex_count(), edges);
}

Matrix along_loops(const Mesh& mesh, const std::vector<std::vector<int>>& loops) {
    double total = 0.0;
    std::size_t count = 0;
    std::vector<Eigen::Triplet<double>> edges;
    for (const std::vector<int>& loop : loops) {
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const int i = loop[k], j = loop[(k + 1) % loop.size()];
            edges.emplace_back(i, j, (mesh.V.row(i) - mesh.V.row(j)).norm());
            total += edges.back().value();
            ++count;
        }
    }
    if (total <= 0.0) return {mesh.vertex_count(), mesh.vertex_count()};
    const double least = kSmallestLength * total / static_cast<double>(count);
    for (auto& edge : edges) edge = {edge.row(), edge.col(), 1.0 / std::max(edge.value(), least)};
    return laplacian(mesh.vertex_count(), edges);
}

}  // namespace

MotionPrior motion_prior(const Mesh& mesh, const std::vector<std::vector<int>>& loops) {
    MotionPrior prior;
    prior.membrane = cotangent_laplacian(mesh);
    prior.border = along_loops(mesh, loops);

    const Eigen::VectorXd mass = vertex_areas(mesh);
    Eigen::VectorXd inverse_mass = mass.cwiseMax(kSmallestMass * mass.mean()).cwiseInverse();
    for (const std::vector<int>& loop : loops) {
        for (const int v : loop) inverse_mass[v] = 0.0;
    }
    Matrix weighted = inverse_mass.asDiagonal() * prior.membrane;
    // The tip of a fan would tie every two of its neighbours, and the factor of thousands is a full matrix.
    weighted.prune([&](int row, int, double) { return prior.membrane.col(row).nonZeros() <= kHub + 1; });
    prior.bending = prior.membrane * weighted;
    return prior;
}

}  // namespace automorph
