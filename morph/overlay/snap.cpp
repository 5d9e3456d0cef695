#include "morph/overlay/snap.h"

#include <algorithm>
#include <limits>
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

/// All pairs within kSnap, nearest first, by sweeping both maps along x.
std::vector<Pair> near_pairs(const Points& rays, const Points& onto) {
    const std::vector<int> order = sorted_by_x(rays), other = sorted_by_x(onto);
    std::vector<Pair> pairs;
    std::size_t first = 0;
    for (const int v : order) {
        while (first < other.size() && onto(other[first], 0) < rays(v, 0) - kSnap) ++first;
        for (std::size_t i = first; i < other.size() && onto(other[i], 0) <= rays(v, 0) + kSnap; ++i) {
            const double distance = (onto.row(other[i]) - rays.row(v)).norm();
            if (distance <= kSnap) pairs.push_back({distance, v, other[i]});
        }
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

/// Moves one vertex if it stays inside its star. Returns whether it moved.
bool move(const Mesh& mesh, const Stars& star, Points& rays, int vertex, const Ray& to, double distance) {
    const Ray before = rays.row(vertex);
    const auto v = static_cast<std::size_t>(vertex);
    double shortest = std::numeric_limits<double>::infinity();
    rays.row(vertex) = to;
    bool valid = true;
    for (int i = star.start[v]; valid && i < star.start[v + 1]; ++i) {
        const int f = star.triangles[static_cast<std::size_t>(i)];
        valid = orientation(rays.row(mesh.F(f, 0)), rays.row(mesh.F(f, 1)), rays.row(mesh.F(f, 2))) > 0;
        for (int k = 0; k < 3; ++k) {
            if (mesh.F(f, k) != vertex) {
                shortest = std::min(shortest, (rays.row(mesh.F(f, k)) - before.transpose()).norm());
            }
        }
    }
    if (valid && distance <= kSnapShare * shortest) return true;
    rays.row(vertex) = before;
    return false;
}

}  // namespace

int snap_vertices(const Mesh& mesh, const std::vector<int>& loop, Points& rays, const Points& onto) {
    std::vector<char> fixed(static_cast<std::size_t>(rays.rows()), 0),
        taken(static_cast<std::size_t>(onto.rows()), 0);
    for (const int v : loop) fixed[static_cast<std::size_t>(v)] = 1;
    const std::vector<Pair> pairs = near_pairs(rays, onto);
    if (pairs.size() == loop.size()) return 0;  // the shared border alone
    const Stars star = stars(mesh);
    int moved = 0;
    for (const Pair& pair : pairs) {
        const auto v = static_cast<std::size_t>(pair.vertex), w = static_cast<std::size_t>(pair.onto);
        if (fixed[v] || taken[w]) {
            taken[w] = taken[w] || pair.distance == 0.0;
            continue;
        }
        if (pair.distance == 0.0 || move(mesh, star, rays, pair.vertex, onto.row(pair.onto), pair.distance)) {
            fixed[v] = taken[w] = 1;
            moved += pair.distance > 0.0;
        }
    }
    return moved;
}

}  // namespace automorph
