#include "morph/overlay/pieces.h"

#include <fmt/format.h>

#include <algorithm>

#include "morph/mesh/errors.h"
#include "morph/mesh/index.h"

// Notation: h is a half-edge of a in the direction of travel, fb a triangle of b, x and y merged vertices.

namespace automorph {

namespace {

using On = Place::On;

class Linker {
public:
    Linker(const MapView& a, const MapView& b, const std::vector<int>& vertex_of_b, CrossingsOfA& known)
        : a_(a),
          b_(b),
          vertex_of_b_(vertex_of_b),
          known_(known),
          leaving_(at(b.half_edges.face_count()), 0) {}

    EdgePieces run(int seed) {
        const HalfEdgeTable& mesh = a_.half_edges;
        result_.edges.reserve(at(mesh.vertex_count() + mesh.face_count()));
        result_.pieces.reserve(result_.edges.capacity() + known_.crossings.size() + vertex_of_b_.size());
        spread(mesh, seed, [&](int h) {
            const auto begin = static_cast<int>(result_.pieces.size());
            follow(h);
            result_.edges.push_back({h, begin, static_cast<int>(result_.pieces.size())});
        });
        return std::move(result_);
    }

private:
    void follow(int h) {
        const int x = a_.half_edges.from(h), y = a_.half_edges.to(h);
        const auto edge = at(a_.half_edges.edge(h));
        const Place start = known_.place[at(x)];
        Place& end = known_.place[at(y)];
        const Crossing* crossings = known_.crossings.data() + known_.first[edge];
        const int count = known_.first[edge + 1] - known_.first[edge];
        const bool starts_inside = start.on == On::Face, ends_inside = end.known() && end.on == On::Face;
        if (known_.touched[edge] || (count == 0 && !starts_inside && !ends_inside)) {
            walk_exactly(x, y, crossings, count);
            return;
        }
        int last = starts_inside ? start.index : end.index;
        if (count == 0) {
            result_.pieces.push_back({last, last, x, y});
        } else {
            last = link(crossings, count, at(h) == edge, x, y);
        }
        if (!end.known()) end = {On::Face, last};
        if (end.on == On::Face && end.index != last) broken(x, y);
    }

    /// Lines up the crossings of an edge and returns the triangle of b after the last.
    int link(const Crossing* crossings, int count, bool forward, int from, int to) {
        const HalfEdgeTable& mesh = b_.half_edges;
        const auto exited = [&](int i) {
            return forward ? mesh.face_across(crossings[i].eb) : HalfEdgeTable::face(crossings[i].eb);
        };
        const auto entered = [&](int i) {
            return forward ? HalfEdgeTable::face(crossings[i].eb) : mesh.face_across(crossings[i].eb);
        };
        int i = first_of(count, exited, entered), x = from, face = -1;
        const Place start = known_.place[at(from)];
        if (start.on == On::Face && (i == count || start.index != exited(i))) broken(from, to);
        for (int linked = 0; linked < count; ++linked) {
            if (linked > 0) i = leaving_[at(face)];
            if (i >= count || (linked > 0 && exited(i) != face)) broken(from, to);
            result_.pieces.push_back({exited(i), exited(i), x, crossings[i].vertex});
            x = crossings[i].vertex;
            face = entered(i);
        }
        result_.pieces.push_back({face, face, x, to});
        return face;
    }

    /// The crossing that no other leads to. Sets leaving_ for the triangles of this edge.
    template <typename Exited, typename Entered>
    int first_of(int count, const Exited& exited, const Entered& entered) {
        if (count == 1) return 0;
        for (int i = 0; i < count; ++i) leaving_[at(exited(i))] = i;
        is_next_.assign(at(count), 0);
        for (int i = 0; i < count; ++i) {
            const int next = leaving_[at(entered(i))];  // of another edge perhaps: ask it
            if (next < count && exited(next) == entered(i)) is_next_[at(next)] = 1;
        }
        return static_cast<int>(std::find(is_next_.begin(), is_next_.end(), 0) - is_next_.begin());
    }

    void walk_exactly(int x, int y, const Crossing* crossings, int count) {
        stretches_.clear();
        Place& end = known_.place[at(y)];
        const Place found = walk(b_, a_.ray(x), a_.ray(y), known_.place[at(x)], end, stretches_);
        if (!end.known() && found.on != On::Face) broken(x, y);
        end = found;
        for (std::size_t i = 0; i < stretches_.size(); ++i) {
            const Stretch& stretch = stretches_[i];
            int to = y;
            if (i + 1 < stretches_.size()) {
                to = stretch.stop.on == On::Vertex ? vertex_of_b_[at(stretch.stop.index)]
                                                   : crossing_with(stretch.stop.index, crossings, count);
                if (to < 0) broken(x, y);
            }
            result_.pieces.push_back({stretch.left, stretch.right, x, to});
            x = to;
        }
    }

    int crossing_with(int eb, const Crossing* crossings, int count) const {
        const auto* const found = std::find_if(crossings, crossings + count, [&](const Crossing& c) {
            return b_.half_edges.edge(c.eb) == b_.half_edges.edge(eb);
        });
        return found == crossings + count ? -1 : found->vertex;
    }

    [[noreturn]] static void broken(int x, int y) {
        throw SolverFailure(
            fmt::format("overlay: the crossings of edge {} {} do not line up: the maps are not one-to-one on "
                        "the same domain",
                        x, y));
    }

    const MapView& a_;
    const MapView& b_;
    const std::vector<int>& vertex_of_b_;
    CrossingsOfA& known_;
    std::vector<int> leaving_;  ///< per triangle of b: the crossing of the present edge by which it is left
    std::vector<char> is_next_;
    std::vector<Stretch> stretches_;
    EdgePieces result_;
};

}  // namespace

EdgePieces pieces_of_a(const MapView& a, const MapView& b, const std::vector<int>& vertex_of_b, int seed,
                       CrossingsOfA& known) {
    return Linker(a, b, vertex_of_b, known).run(seed);
}

}  // namespace automorph
