#include "morph/mesh/half_edge_table.h"

#include <fmt/format.h>

#include <numeric>

#include "morph/mesh/errors.h"

namespace automorph {

namespace {

/// Calls visit(half-edge, from, to) for the three sides of every triangle.
template <typename Visit>
void for_each_side(const Triangles& F, const Visit& visit) {
    for (int f = 0; f < F.rows(); ++f) {
        const int u = F(f, 0), v = F(f, 1), w = F(f, 2);
        visit(3 * f, u, v);
        visit(3 * f + 1, v, w);
        visit(3 * f + 2, w, u);
    }
}

}  // namespace

HalfEdgeTable::HalfEdgeTable(const Triangles& F, int vertex_count)
    : F_(F),
      opposite_(static_cast<std::size_t>(F.size()), -1),
      outgoing_(static_cast<std::size_t>(vertex_count), -1) {
    // Half-edges from the smaller vertex are filed under it; the others look for theirs among the few there.
    struct Filed {
        int to, halfedge;
    };
    std::vector<int> start(static_cast<std::size_t>(vertex_count) + 1, 0);
    for_each_side(F, [&](int, int from, int to) { start[static_cast<std::size_t>(from) + 1] += from < to; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<int> end(start.begin(), start.end() - 1);
    std::vector<Filed> filed(static_cast<std::size_t>(start.back()));
    for_each_side(F, [&](int h, int from, int to) {
        if (from < to) filed[static_cast<std::size_t>(end[static_cast<std::size_t>(from)]++)] = {to, h};
    });
    for_each_side(F, [&](int h, int from, int to) {
        if (from < to) return;
        for (int i = start[static_cast<std::size_t>(to)]; i < end[static_cast<std::size_t>(to)]; ++i) {
            const Filed& other = filed[static_cast<std::size_t>(i)];
            if (other.to != from) continue;
            opposite_[static_cast<std::size_t>(other.halfedge)] = h;
            opposite_[static_cast<std::size_t>(h)] = other.halfedge;
        }
    });
    for (int h = 0; h < count(); ++h) {
        if (opposite(h) >= 0 && opposite(opposite(h)) != h) {
            throw InvalidMesh(fmt::format("edge {} {} has more than two triangles", from(h), to(h)));
        }
        int& out = outgoing_[static_cast<std::size_t>(from(h))];
        if (out < 0 || opposite(h) < 0) out = h;
    }
}

}  // namespace automorph
