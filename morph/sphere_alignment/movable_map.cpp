#include "morph/sphere_alignment/movable_map.h"

#include <fmt/format.h>

#include <numeric>

#include "morph/mesh/errors.h"
#include "morph/parameterization/map_quality.h"
#include "morph/sphere_alignment/guarded_move.h"

namespace automorph {

namespace {

/// Rounds of moving, relaxing sweeps after each, and those over the vertices that are not in place after the
/// last.
constexpr int kRounds = 6, kSweepsPerRound = 3, kLateSweeps = 10;

/// Halvings of a move as a whole that would make the map cover the sphere twice; then nothing moves.
constexpr int kShorterMoves = 8;

}  // namespace

MovableMap::MovableMap(const Mesh& mesh, const std::vector<int>& loop, const Points& rays)
    : mesh_(mesh),
      closed_(closed_with_apex(mesh, loop)),
      relaxation_(half_edges(closed_.mesh.F, closed_.mesh.vertex_count()), closed_.mesh.V, closed_.fixed,
                  total_solid_angle(mesh.F, rays)) {
    relaxation_.rays.topRows(rays.rows()) = rays;
    if (!loop.empty()) relaxation_.rays.bottomRows(1) << 0.0, 0.0, -1.0;  // the apex
    std::vector<int> triangles(static_cast<std::size_t>(closed_.surface));
    std::iota(triangles.begin(), triangles.end(), 0);
    relaxation_.measure(triangles);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (closed_.fixed.empty() || !closed_.fixed[static_cast<std::size_t>(v)]) vertices_.push_back(v);
    }
}

std::vector<int> MovableMap::move(const Points& wanted) {
    const Points before = rays();
    Points goal = before;
    for (const int v : vertices_) goal.row(v) = wanted.row(v);
    Points wanted_now = goal;
    for (int halvings = 0;; ++halvings) {
        relaxation_.rays.topRows(before.rows()) = move_guarded(mesh_.F, before, wanted_now).rays;
        const int degree = covering_degree(closed_.mesh.F, relaxation_.rays);
        if (degree == 1) break;
        if (halvings > kShorterMoves)
            throw SolverFailure(fmt::format("alignment on the sphere: a map covers it {} times", degree));
        wanted_now = halvings < kShorterMoves ? (before + wanted_now).rowwise().normalized().eval() : before;
    }
    std::vector<int> late;
    for (const int v : vertices_) {
        if (relaxation_.rays.row(v) != goal.row(v)) late.push_back(v);
    }
    return late;
}

int MovableMap::follow(const Points& wanted) {
    std::vector<int> late = move(wanted);
    for (int round = 0; round < kRounds && !late.empty(); ++round) {
        relax(kSweepsPerRound);
        late = move(wanted);
    }
    relaxation_.wake();
    relaxation_.sweep(late, kLateSweeps);
    return static_cast<int>(late.size());
}

void MovableMap::relax(int sweeps) {
    relaxation_.wake();
    relaxation_.sweep(vertices_, sweeps);
}

}  // namespace automorph
