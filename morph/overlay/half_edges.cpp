#include "morph/overlay/half_edges.h"

#include <fmt/format.h>

#include <numeric>

#include "morph/mesh/errors.h"

namespace automorph {

HalfEdges::HalfEdges(const Triangles& F, int vertex_count)
    : F_(F),
      opposite_(static_cast<std::size_t>(F.size()), -1),
      outgoing_(static_cast<std::size_t>(vertex_count), -1) {
    // Half-edges from the smaller vertex are filed under it; the others look for theirs among the few there.
    std::vector<int> start(static_cast<std::size_t>(vertex_count) + 1, 0);
    for (int h = 0; h < count(); ++h) start[static_cast<std::size_t>(from(h)) + 1] += from(h) < to(h);
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<int> end(start.begin(), start.end() - 1), filed(static_cast<std::size_t>(start.back()));
    for (int h = 0; h < count(); ++h) {
        if (from(h) < to(h)) filed[static_cast<std::size_t>(end[static_cast<std::size_t>(from(h))]++)] = h;
    }
    for (int h = 0; h < count(); ++h) {
        if (from(h) < to(h)) continue;
        for (int i = start[static_cast<std::size_t>(to(h))]; i < end[static_cast<std::size_t>(to(h))]; ++i) {
            const int other = filed[static_cast<std::size_t>(i)];
            if (to(other) != from(h)) continue;
            opposite_[static_cast<std::size_t>(other)] = h;
            opposite_[static_cast<std::size_t>(h)] = other;
        }
    }
    for (int h = 0; h < count(); ++h) {
        if (opposite(h) >= 0 && opposite(opposite(h)) != h) {
            throw InvalidMesh(fmt::format("edge {} {} has more than two triangles", from(h), to(h)));
        }
        int& out = outgoing_[static_cast<std::size_t>(from(h))];
        if (out < 0 || opposite(h) < 0) out = h;
    }
}

}  // namespace automorph
