#include "morph/overlay/half_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "morph/mesh/errors.h"

namespace automorph {

HalfEdges::HalfEdges(const Triangles& F, int vertex_count)
    : F_(F),
      opposite_(static_cast<std::size_t>(F.size()), -1),
      outgoing_(static_cast<std::size_t>(vertex_count), -1) {
    // Filed by the smaller vertex; the few of one vertex are compared with one another.
    struct Entry {
        int larger, halfedge;
    };
    std::vector<int> start(static_cast<std::size_t>(vertex_count) + 1, 0);
    for (int h = 0; h < count(); ++h) ++start[static_cast<std::size_t>(std::min(from(h), to(h))) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<int> end(start.begin(), start.end() - 1);
    std::vector<Entry> entries(opposite_.size());
    for (int h = 0; h < count(); ++h) {
        const auto [smaller, larger] = std::minmax({from(h), to(h)});
        int& filed = end[static_cast<std::size_t>(smaller)];
        for (int i = start[static_cast<std::size_t>(smaller)]; i < filed; ++i) {
            const Entry& other = entries[static_cast<std::size_t>(i)];
            if (other.larger != larger) continue;
            int& partner = opposite_[static_cast<std::size_t>(other.halfedge)];
            if (partner >= 0 || from(other.halfedge) == from(h)) {
                throw InvalidMesh(fmt::format("triangles {} and {} run along edge {} {} in one direction",
                                              face(other.halfedge), face(h), from(h), to(h)));
            }
            partner = h;
            opposite_[static_cast<std::size_t>(h)] = other.halfedge;
        }
        entries[static_cast<std::size_t>(filed++)] = {larger, h};
    }
    for (int h = 0; h < count(); ++h) {
        int& out = outgoing_[static_cast<std::size_t>(from(h))];
        if (out < 0 || opposite(h) < 0) out = h;
    }
}

}  // namespace automorph
