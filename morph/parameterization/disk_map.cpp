#include "morph/parameterization/disk_map.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "morph/mesh/errors.h"
#include "morph/parameterization/repair_map.h"

namespace automorph {

// Notation: h planar image of a vertex, w_ij edge weights, L = diag(sum_j w_ij) - w restricted to free
// vertices.

namespace {

using Planar = Eigen::MatrixX2d;

/// Steps of iterative refinement after the first solve; the second one changes little on any mesh seen.
constexpr int kRefinements = 2;

/// Vertices of the border are fixed, the others are numbered as unknowns.
struct Unknowns {
    std::vector<int> row;  ///< per vertex, -1 on the border
    int count = 0;
};

Unknowns number_unknowns(const Mesh& mesh, const std::vector<int>& loop) {
    Unknowns unknowns;
    unknowns.row.assign(static_cast<std::size_t>(mesh.vertex_count()), 0);
    for (const int v : loop) unknowns.row[static_cast<std::size_t>(v)] = -1;
    for (int& row : unknowns.row) {
        if (row >= 0) row = unknowns.count++;
    }
    return unknowns;
}

/// Counts are those of a disk with this loop as its border and no unused vertex.
void require_disk(const Mesh& mesh, const std::vector<int>& loop, const Points& border) {
    // Every edge has two sides but those of the border: E = (3 F + B) / 2, and V - E + F = 1.
    const std::int64_t V = mesh.vertex_count(), F = mesh.triangle_count(),
                       B = static_cast<std::int64_t>(loop.size());
    const std::int64_t doubled_euler = 2 * V - (3 * F + B) + 2 * F;
    std::vector<char> used(static_cast<std::size_t>(V), 0);
    for (int f = 0; f < F; ++f) {
        for (int k = 0; k < 3; ++k) used[static_cast<std::size_t>(mesh.F(f, k))] = 1;
    }
    const auto unused = std::count(used.begin(), used.end(), 0);
    if (B < 3 || doubled_euler != 2 || unused > 0 || border.rows() != B) {
        throw InvalidMesh(
            fmt::format("a disk with one border is needed: V - E + F should be 1 and is {} ({} vertices, {} "
                        "of them unused, {} "
                        "triangles, border of {} vertices with {} places)",
                        static_cast<double>(doubled_euler) / 2.0, V, unused, F, B, border.rows()));
    }
}

/// sum_j w_ij (h_j - h_i) per free vertex. Differences of near places lose no digits, so that the residual is
/// right relative to the local size of the map, where b - L h would only be right relative to the disk.
Planar residual(const WeightMatrix& weights, const Unknowns& unknowns, const Points& rays) {
    Planar r = Planar::Zero(unknowns.count, 2);
    for (int v = 0; v < rays.rows(); ++v) {
        const int row = unknowns.row[static_cast<std::size_t>(v)];
        if (row < 0) continue;
        for (decltype(weights.w)::InnerIterator it(weights.w, row); it; ++it) {
            r.row(row) += it.value() * (rays.row(it.col()) - rays.row(v)).head<2>();
        }
    }
    return r;
}

/// L; only the lower triangle if `symmetric`.
Eigen::SparseMatrix<double> laplacian(const WeightMatrix& weights, const Unknowns& unknowns, bool symmetric) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(weights.w.nonZeros()) +
                    static_cast<std::size_t>(unknowns.count));
    for (int row = 0; row < unknowns.count; ++row) {
        double sum = 0.0;
        for (decltype(weights.w)::InnerIterator it(weights.w, row); it; ++it) {
            sum += it.value();
            const int column = unknowns.row[static_cast<std::size_t>(it.col())];
            if (column >= 0 && (!symmetric || column < row)) entries.emplace_back(row, column, -it.value());
        }
        entries.emplace_back(row, row, sum);
    }
    Eigen::SparseMatrix<double> L(unknowns.count, unknowns.count);
    L.setFromTriplets(entries.begin(), entries.end());
    return L;
}

/// A solution with its residual; empty if the factorisation failed.
struct Solution {
    Points rays;
    double residual = 0.0;
};

template <class Solver>
std::optional<Solution> solve(const Solver& solver, const WeightMatrix& weights, const Unknowns& unknowns,
                              const Points& start) {
    // From all free vertices in the centre the first refinement step is the solve itself.
    Solution best{start, 1.0};
    Planar r = residual(weights, unknowns, start);
    const double scale = r.norm();
    double norm = scale;
    for (int step = 0; step <= kRefinements && norm > 0.0; ++step) {
        const Planar dh = solver.solve(r);
        if (!dh.allFinite()) return std::nullopt;
        Points moved = best.rays;
        for (int v = 0; v < moved.rows(); ++v) {
            const int row = unknowns.row[static_cast<std::size_t>(v)];
            if (row >= 0) moved.row(v).head<2>() += dh.row(row);
        }
        r = residual(weights, unknowns, moved);
        if (step > 0 && r.norm() >= norm) break;
        norm = r.norm();
        best = {std::move(moved), norm / scale};
    }
    return best;
}

std::optional<Solution> solve(const WeightMatrix& weights, const Unknowns& unknowns, const Points& start,
                              MapWeights kind) {
    if (unknowns.count == 0) return Solution{start, 0.0};
    if (kind == MapWeights::MeanValue) {
        // Rows are diagonally dominant: elimination is stable without pivoting.
        Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> solver;
        solver.setPivotThreshold(0.0);
        solver.compute(laplacian(weights, unknowns, false));
        if (solver.info() != Eigen::Success) return std::nullopt;
        return solve(solver, weights, unknowns, start);
    }
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(laplacian(weights, unknowns, true));
    if (solver.info() != Eigen::Success) return std::nullopt;
    return solve(solver, weights, unknowns, start);
}

void append(std::string& text, const std::string& sentence) {
    if (!text.empty()) text += "; ";
    text += sentence;
}

}  // namespace

DiskMap disk_map(const Mesh& mesh, const std::vector<int>& loop, const Points& border,
                 const DiskMapOptions& options) {
    require_disk(mesh, loop, border);
    const Unknowns unknowns = number_unknowns(mesh, loop);
    Points start(mesh.vertex_count(), 3);
    start.rowwise() = Eigen::RowVector3d(0.0, 0.0, 1.0);
    for (std::size_t k = 0; k < loop.size(); ++k)
        start.row(loop[k]) = border.row(static_cast<Eigen::Index>(k));

    std::vector<char> fixed(static_cast<std::size_t>(mesh.vertex_count()));
    for (std::size_t v = 0; v < fixed.size(); ++v) fixed[v] = unknowns.row[v] < 0 ? 1 : 0;
    DiskMap map, fewest;
    fewest.quality.flipped = std::numeric_limits<int>::max();
    // `found` with its flipped triangles turned by moving vertices, if that can be done.
    const auto repaired = [&](DiskMap found) -> std::optional<DiskMap> {
        RepairedMap repair = repair_map(mesh, fixed, found.rays);
        if (repair.flipped > 0) {
            append(map.reason, fmt::format("{} remain after repair", repair.flipped));
            return std::nullopt;
        }
        found.reason = map.reason;
        append(found.reason, fmt::format("{} vertices of the {} map were moved one by one", repair.moved,
                                         name(found.weights)));
        found.rays = std::move(repair.rays);
        found.repaired = repair.moved;
        found.quality = map_quality(mesh, found.rays);
        return found;
    };
    for (const MapWeights kind : {MapWeights::Cotangent, MapWeights::MeanValue, MapWeights::Uniform}) {
        if (kind < options.first || (kind > options.first && !options.fallbacks)) continue;
        const WeightMatrix weights = weight_matrix(mesh, unknowns.row, unknowns.count, kind);
        auto solution = solve(weights, unknowns, start, kind);
        if (!solution) {
            append(map.reason, fmt::format("the system of {} weights cannot be factorised", name(kind)));
            continue;
        }
        map.rays = std::move(solution->rays);
        map.residual = solution->residual;
        map.weights = kind;
        map.guarded = weights.guarded;
        map.quality.flipped = flipped_triangles(mesh.F, map.rays);
        if (map.quality.flipped == 0) {
            map.quality = map_quality(mesh, map.rays);
            return map;
        }
        append(map.reason, fmt::format("{} weights flip {} triangle{}", name(kind), map.quality.flipped,
                                       map.quality.flipped == 1 ? "" : "s"));
        // Positive weights flip by rounding alone: whether they do is chance, and must not choose the map.
        if (kind == MapWeights::MeanValue && options.fallbacks) {
            if (auto mean_value = repaired(map)) return *mean_value;
        }
        if (map.quality.flipped < fewest.quality.flipped) fewest = map;
    }
    if (options.fallbacks && fewest.rays.rows() > 0 && fewest.weights != MapWeights::MeanValue) {
        if (auto last = repaired(fewest)) return *last;
    }
    throw SolverFailure(fmt::format("no one-to-one map onto the disk: {} ({} vertices, {} triangles)",
                                    map.reason, mesh.vertex_count(), mesh.triangle_count()));
}

}  // namespace automorph
