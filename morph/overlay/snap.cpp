#include "morph/overlay/snap.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "morph/exact/predicates.h"

namespace automorph {

namespace {

/// A vertex moves by no more than this share of its shortest edge in the map.
constexpr double kSnapShare = 1e-3;

std::vector<int> sorted_by_x(const Points& rays) {
    std::vector<int> order(static_cast<std::size_t>(rays.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int i, int j) { return rays(i, 0) < rays(j, 0); });
    return order;
}

struct Pair {
    double distance;
    int vertex, onto;
};

/// How far each vertex may move: kSnap, and kSnapShare of its shortest edge in the map (#V).
Eigen::VectorXd reaches(const Mesh& mesh, const Points& rays) {
    Eigen::VectorXd reach = Eigen::VectorXd::Constant(rays.rows(), kSnap);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.F(f, k), w = mesh.F(f, (k + 1) % 3);
            const double share = kSnapShare * (rays.row(v) - rays.row(w)).norm();
            reach[v] = std::min(reach[v], share);
            reach[w] = std::min(reach[w], share);
        }
    }
    return reach;
}

/// All pairs within reach, nearest first, by sweeping both maps along x. Where a map is squeezed its reach is
/// small too, so that no vertex has many partners.
std::vector<Pair> near_pairs(const Mesh& mesh, const Points& rays, const Points& onto) {
    const Eigen::VectorXd reach = reaches(mesh, rays);
    const std::vector<int> order = sorted_by_x(rays), other = sorted_by_x(onto);
    std::vector<Pair> pairs;
    std::size_t first = 0;
    for (const int v : order) {
        while (first < other.size() && onto(other[first], 0) < rays(v, 0)) ++first;
        const auto consider = [&](int w) {
            const double distance = (onto.row(w) - rays.row(v)).norm();
            if (distance <= reach[v]) pairs.push_back({distance, v, w});
        };
        for (std::size_t i = first; i < other.size() && onto(other[i], 0) <= rays(v, 0) + reach[v]; ++i)
            consider(other[i]);
        for (std::size_t i = first; i > 0 && onto(other[i - 1], 0) >= rays(v, 0) - reach[v]; --i)
            consider(other[i - 1]);
    }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
        return std::tie(p.distance, p.vertex, p.onto) < std::tie(q.distance, q.vertex, q.onto);
    });
    return pairs;
}

/// Triangles around each vertex, as offsets into a list.
struct Stars {
    std::vector<int> start, triangles;
};

Stars stars(const Mesh& mesh) {
    Stars result;
    result.start.assign(static_cast<std::size_t>(mesh.vertex_count()) + 1, 0);
    for (int i = 0; i < mesh.F.size(); ++i) ++result.start[static_cast<std::size_t>(mesh.F.data()[i]) + 1];
    std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
    result.triangles.resize(static_cast<std::size_t>(mesh.F.size()));
    std::vector<int> next(result.start.begin(), result.start.end() - 1);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            result.triangles[static_cast<std::size_t>(next[static_cast<std::size_t>(mesh.F(f, k))]++)] = f;
        }
    }
    return result;
}

/// Moves one vertex if none of its triangles turns. Returns whether it moved.
bool move(const Mesh& mesh, const Stars& star, Points& rays, int vertex, const Ray& to) {
    const Ray before = rays.row(vertex);
    const auto v = static_cast<std::size_t>(vertex);
    rays.row(vertex) = to;
    for (int i = star.start[v]; i < star.start[v + 1]; ++i) {
        const int f = star.triangles[static_cast<std::size_t>(i)];
        if (orientation(rays.row(mesh.F(f, 0)), rays.row(mesh.F(f, 1)), rays.row(mesh.F(f, 2))) > 0) continue;
        rays.row(vertex) = before;
        return false;
    }
    return true;
}

}  // namespace

int snap_vertices(const Mesh& mesh, const std::vector<int>& loop, Points& rays, const Points& onto) {
    std::vector<char> fixed(static_cast<std::size_t>(rays.rows()), 0),
        taken(static_cast<std::size_t>(onto.rows()), 0);
    for (const int v : loop) fixed[static_cast<std::size_t>(v)] = 1;
    const std::vector<Pair> pairs = near_pairs(mesh, rays, onto);
    if (pairs.size() == loop.size()) return 0;  // the shared border alone
    const Stars star = stars(mesh);
    int moved = 0;
    for (const Pair& pair : pairs) {
        const auto v = static_cast<std::size_t>(pair.vertex), w = static_cast<std::size_t>(pair.onto);
        if (fixed[v] || taken[w]) {
            taken[w] = taken[w] || pair.distance == 0.0;
            continue;
        }
        if (pair.distance == 0.0 || move(mesh, star, rays, pair.vertex, onto.row(pair.onto))) {
            fixed[v] = taken[w] = 1;
            moved += pair.distance > 0.0;
        }
    }
    return moved;
}

}  // namespace automorph
