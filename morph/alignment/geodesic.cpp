#include "morph/alignment/geodesic.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

#include "morph/mesh/half_edge_table.h"
#include "morph/mesh/index.h"

namespace automorph {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Line {
    int from, to;
    double length;
};

/// The apex of a triangle whose edge runs from the origin along x, `side` +1 above it, -1 below.
Vector2d unfolded(const Vector3d& origin, const Vector3d& along, const Vector3d& apex, double side) {
    const Vector3d to_apex = apex - origin;
    const double x = to_apex.dot(along);
    return {x, side * (to_apex - x * along).norm()};
}

/// The line between the apices on both sides of half-edge h, if it crosses the edge between its ends.
bool line_across(const HalfEdgeTable& half_edges, const Points& V, int h, Line& line) {
    const int opposite = half_edges.opposite(h);
    if (opposite < 0) return false;
    line = {half_edges.apex(h), half_edges.apex(opposite), 0.0};
    const Vector3d a = V.row(half_edges.from(h)), edge = V.row(half_edges.to(h)).transpose() - a;
    const double length = edge.norm();
    if (length <= 0.0 || line.from == line.to) return false;
    const Vector2d p = unfolded(a, edge / length, V.row(line.from), 1.0),
                   q = unfolded(a, edge / length, V.row(line.to), -1.0);
    const double height = p[1] - q[1];
    if (height <= 0.0) return false;
    const double crossing = (q[0] * p[1] - p[0] * q[1]) / height;
    if (crossing <= 0.0 || crossing >= length) return false;
    line.length = (p - q).norm();
    return true;
}

}  // namespace

SurfaceDistances::SurfaceDistances(const Mesh& mesh) {
    const HalfEdgeTable half_edges(mesh.F, mesh.vertex_count());
    std::vector<Line> lines;
    for (int h = 0; h < half_edges.count(); ++h) {
        if (half_edges.edge(h) != h) continue;
        const int u = half_edges.from(h), v = half_edges.to(h);
        lines.push_back({u, v, (mesh.V.row(u) - mesh.V.row(v)).norm()});
        Line across{};
        if (line_across(half_edges, mesh.V, h, across)) lines.push_back(across);
    }
    start_.assign(at(mesh.vertex_count()) + 1, 0);
    for (const Line& line : lines) {
        ++start_[at(line.from) + 1];
        ++start_[at(line.to) + 1];
    }
    for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
    to_.resize(2 * lines.size());
    length_.resize(2 * lines.size());
    std::vector<int> next(start_.begin(), start_.end() - 1);
    for (const Line& line : lines) {
        for (const auto& [u, v] : {std::pair{line.from, line.to}, std::pair{line.to, line.from}}) {
            const int slot = next[at(u)]++;
            to_[at(slot)] = v;
            length_[at(slot)] = line.length;
        }
    }
}

Eigen::VectorXd SurfaceDistances::from(const std::vector<int>& vertices) const {
    Eigen::VectorXd distance = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(start_.size()) - 1,
                                                         std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (const int v : vertices) {
        distance[v] = 0.0;
        front.emplace(0.0, v);
    }
    while (!front.empty()) {
        const auto [reached, v] = front.top();
        front.pop();
        if (reached > distance[v]) continue;
        for (int slot = start_[at(v)]; slot < start_[at(v) + 1]; ++slot) {
            const int w = to_[at(slot)];
            const double farther = reached + length_[at(slot)];
            if (farther >= distance[w]) continue;
            distance[w] = farther;
            front.emplace(farther, w);
        }
    }
    return distance;
}

}  // namespace automorph
