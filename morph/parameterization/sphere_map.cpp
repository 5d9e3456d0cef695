#include "morph/parameterization/sphere_map.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "morph/exact/predicates.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/index.h"
#include "morph/parameterization/decimation.h"
#include "morph/parameterization/sphere_border.h"
#include "morph/parameterization/sphere_relaxation.h"

namespace automorph {

namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;
/// All is relaxed whenever the number of vertices has grown by this factor, with so many sweeps at most:
/// small meshes are cheap and everything later starts from them.
constexpr double kGrowth = 1.3;
constexpr int kSmall = 2000, kSweepsSmall = 20, kSweeps = 4, kLastSweeps = 30;
/// Valence above which a neighbour of a new vertex is left to the sweeps.
constexpr int kHub = 40;
/// Sweeps over everything that make room for a vertex that finds none.
constexpr int kRoom = 10;
/// Solid angles are good to a few digits less than full.
constexpr double kAngleTolerance = 1e-6;

/// Regular tetrahedron, corners 0 1 2 counter-clockwise seen from outside.
Eigen::Matrix<double, 4, 3> tetrahedron() {
    Eigen::Matrix<double, 4, 3> corners;
    corners << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1;
    return corners / std::sqrt(3.0);
}

/// A mesh numbered along a walk over it, breadth first: neighbours are near each other in memory, which
/// halves the time of large meshes whose files have them in any order.
struct NumberedMesh {
    ClosedMesh closed;
    std::vector<int> new_number;  ///< per vertex
};

NumberedMesh numbered_by_neighbours(const ClosedMesh& closed) {
    const HalfEdges edges = half_edges(closed.mesh.F, closed.mesh.vertex_count());
    NumberedMesh result{closed, std::vector<int>(at(closed.mesh.vertex_count()), -1)};
    std::vector<int> walk{0};
    result.new_number[0] = 0;
    for (std::size_t k = 0; k < walk.size(); ++k) {
        int h = edges.out[at(walk[k])];
        for (int j = 0; j < edges.valence[at(walk[k])]; ++j, h = edges.turn(h)) {
            const int w = edges.target(h);
            if (result.new_number[at(w)] >= 0) continue;
            result.new_number[at(w)] = static_cast<int>(walk.size());
            walk.push_back(w);
        }
    }
    if (static_cast<int>(walk.size()) != closed.mesh.vertex_count()) {
        throw InvalidMesh(fmt::format("one component is needed: {} of {} vertices are joined to the first",
                                      walk.size(), closed.mesh.vertex_count()));
    }
    for (int v = 0; v < closed.mesh.vertex_count(); ++v) {
        result.closed.mesh.V.row(result.new_number[at(v)]) = closed.mesh.V.row(v);
        if (!closed.fixed.empty()) result.closed.fixed[at(result.new_number[at(v)])] = closed.fixed[at(v)];
    }
    // Triangles of the surface by their first corner, the apex' behind them.
    std::vector<int> order(at(closed.mesh.triangle_count())), first(order.size());
    std::iota(order.begin(), order.end(), 0);
    for (int f = 0; f < closed.mesh.triangle_count(); ++f) {
        first[at(f)] = result.new_number[at(closed.mesh.F(f, 0))];
        for (int k = 1; k < 3; ++k)
            first[at(f)] = std::min(first[at(f)], result.new_number[at(closed.mesh.F(f, k))]);
    }
    std::stable_sort(order.begin(), order.begin() + closed.surface,
                     [&](int f, int g) { return first[at(f)] < first[at(g)]; });
    for (int f = 0; f < closed.mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k)
            result.closed.mesh.F(f, k) = result.new_number[at(closed.mesh.F(order[at(f)], k))];
    }
    return result;
}

/// Down and up again.
class Embedding {
public:
    Embedding(const ClosedMesh& closed, double domain)
        : surface_(closed.surface),
          fixed_(closed.fixed),
          V_(scaled(closed, domain)),
          relaxation_(half_edges(closed.mesh.F, closed.mesh.vertex_count()), V_, fixed_, domain) {}

    /// @param fixed_rays  rows of fixed vertices are set
    Points run(const Points& fixed_rays) {
        collapses_ = decimate(relaxation_.mesh, V_, fixed_);
        place_base(fixed_rays);
        double next_sweep = 0.0;
        for (int k = static_cast<int>(collapses_.size()); k > 0; --k) {
            if (static_cast<double>(vertices_.size()) >= next_sweep) {
                relax_all(vertices_.size() < at(kSmall) ? kSweepsSmall : kSweeps);
                next_sweep = kGrowth * static_cast<double>(vertices_.size());
            }
            put_back(collapses_[at(k - 1)]);
        }
        relax_all(kLastSweeps);
        return relaxation_.rays;
    }

private:
    static Points scaled(const ClosedMesh& closed, double domain) {
        const Points V = closed.mesh.V.rowwise() - closed.mesh.V.colwise().mean();
        const double area = triangle_areas({V, closed.mesh.F.topRows(closed.surface)}).sum();
        if (!(area > 0.0)) {
            throw InvalidMesh(
                "the mesh has no area: all its triangles are degenerate, no map onto the sphere exists");
        }
        return V * std::sqrt(domain / area);
    }

    void place_base(const Points& fixed_rays) {
        HalfEdges& mesh = relaxation_.mesh;
        std::vector<char> gone(at(static_cast<int>(V_.rows())), 0), removed(mesh.origin.size() / 4, 0);
        for (const int h : collapses_) {
            gone[at(mesh.origin[at(h)])] = 1;
            removed[at(HalfEdges::triangle(h))] = removed[at(HalfEdges::triangle(mesh.twin(h)))] = 1;
        }
        for (int f = 0; f < surface_; ++f) {
            if (!removed[at(f)]) triangles_.push_back(f);
        }
        for (int v = 0; v < V_.rows(); ++v) {
            if (!gone[at(v)] && (fixed_.empty() || !fixed_[at(v)])) vertices_.push_back(v);
        }
        if (!fixed_.empty()) {
            relaxation_.rays = fixed_rays;
            for (const int v : vertices_) relaxation_.rays.row(v) << 0.0, 0.0, 1.0;
            return;
        }
        const auto corners = tetrahedron();
        const int first = 4 * triangles_.front();
        for (const int v : vertices_) relaxation_.rays.row(v) = corners.row(3);
        for (int k = 0; k < 3; ++k) relaxation_.rays.row(mesh.origin[at(first + k)]) = corners.row(k);
    }

    void relax_all(int sweeps) {
        // In the order of their numbers, which lie near each other in memory more often than in the order of
        // return.
        std::sort(vertices_.begin(), vertices_.end());
        relaxation_.measure(triangles_);
        relaxation_.wake();
        relaxation_.sweep(vertices_, sweeps);
    }

    void put_back(int h) {
        HalfEdges& mesh = relaxation_.mesh;
        mesh.undo(h);
        const int v = mesh.origin[at(h)];
        for_each_leaving(v, [&](int x) { relaxation_.measure_triangle(HalfEdges::triangle(x)); });
        if (!relaxation_.insert(v)) {
            mesh.collapse(h);
            relax_all(kRoom);
            mesh.undo(h);
            for_each_leaving(v, [&](int x) { relaxation_.measure_triangle(HalfEdges::triangle(x)); });
            if (!relaxation_.insert(v)) {
                throw SolverFailure(
                    fmt::format("progressive sphere map: no room for vertex {} among its {} neighbours in "
                                "doubles ({} of {} "
                                "vertices placed)",
                                v, mesh.valence[at(v)], vertices_.size(), V_.rows()));
            }
        }
        triangles_.push_back(HalfEdges::triangle(h));
        triangles_.push_back(HalfEdges::triangle(mesh.twin(h)));
        vertices_.push_back(v);
        relaxation_.relax(v);
        for_each_leaving(v, [&](int x) {
            const int w = mesh.target(x);
            if (mesh.valence[at(w)] <= kHub) relaxation_.relax(w);
        });
    }

    template <class Do>
    void for_each_leaving(int v, const Do& act) {
        const HalfEdges& mesh = relaxation_.mesh;
        const int first = mesh.out[at(v)];
        int h = first;
        do {
            act(h);
            h = mesh.turn(h);
        } while (h != first);
    }

    int surface_;
    std::vector<char> fixed_;
    Points V_;
    SphereRelaxation relaxation_;
    std::vector<int> collapses_;
    std::vector<int> triangles_, vertices_;  ///< in the mesh: of the surface; not fixed
};

/// @param fixed_rays  rows of fixed vertices are set; #V x 3, or empty without any
Points embedded(const ClosedMesh& closed, const Points& fixed_rays, double domain) {
    const NumberedMesh numbered = numbered_by_neighbours(closed);
    Points start(fixed_rays.rows(), 3);
    for (Eigen::Index v = 0; v < start.rows(); ++v)
        start.row(numbered.new_number[static_cast<std::size_t>(v)]) = fixed_rays.row(v);
    const Points rays = Embedding(numbered.closed, domain).run(start);
    return rays(numbered.new_number, Eigen::all);
}

SphereMap checked(const Mesh& mesh, Points rays, double domain) {
    SphereMap map;
    map.rays = std::move(rays);
    map.quality = sphere_map_quality(mesh, map.rays);
    map.solid_angle = total_solid_angle(mesh.F, map.rays);
    if (map.quality.flipped > 0 || std::abs(map.solid_angle - domain) > kAngleTolerance * domain) {
        throw SolverFailure(
            fmt::format("progressive sphere map: {} of {} triangles flipped, solid angle {} instead of {}",
                        map.quality.flipped, mesh.triangle_count(), map.solid_angle, domain));
    }
    return map;
}

}  // namespace

SphereMap sphere_map(const Mesh& mesh) {
    if (2 * mesh.vertex_count() - 4 != mesh.triangle_count()) {
        throw InvalidMesh(fmt::format(
            "a closed mesh of genus 0 is needed, with 2 V - 4 triangles: {} vertices, {} triangles",
            mesh.vertex_count(), mesh.triangle_count()));
    }
    return checked(mesh, embedded(closed_with_apex(mesh, {}), {}, kSphere), kSphere);
}

SphereMap sphere_map(const Mesh& mesh, const std::vector<int>& loop, const Points& border) {
    const int vertices = mesh.vertex_count(), triangles = mesh.triangle_count(),
              n = static_cast<int>(loop.size());
    if (n < 3 || border.rows() != n || 2 * (vertices + 1) - 4 != triangles + n) {
        throw InvalidMesh(fmt::format(
            "a disk with one border is needed: {} vertices, {} triangles, border of {} vertices with {} "
            "places",
            vertices, triangles, n, border.rows()));
    }
    if (n == vertices) throw InvalidMesh("a disk with an inner vertex is needed: split its chords first");
    const ClosedMesh closed = closed_with_apex(mesh, loop);
    const Ray north(0.0, 0.0, 1.0);
    Points rays = Points::Zero(vertices + 1, 3);
    rays.row(vertices) = -north;
    for (int k = 0; k < n; ++k) rays.row(loop[at(k)]) = border.row(k);
    for (int k = 0; k < n; ++k) {
        const Ray from = border.row(k), to = border.row((k + 1) % n);
        if (orientation(north, from, to) <= 0 || orientation(-north, to, from) <= 0) {
            throw InvalidMesh(
                fmt::format("border places {} and {} do not follow each other round the pole", k, k + 1));
        }
    }
    const double domain = kSphere - total_solid_angle(closed.mesh.F.bottomRows(n), rays);
    return checked(mesh, embedded(closed, rays, domain).topRows(vertices), domain);
}

}  // namespace automorph
