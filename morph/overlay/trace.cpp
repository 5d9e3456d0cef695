#include "morph/overlay/trace.h"

#include <fmt/format.h>

#include <optional>

#include "morph/mesh/errors.h"

// Notation: the segment p -> q is walked through triangles (u, v, w); s_x = sign det[p q x] is +1 left of it.

namespace automorph {

namespace {

using On = Place::On;

/// Walks one segment through a map.
class Walker {
public:
    Walker(const MapView& map, const Ray& p, const Ray& q, Place end, std::vector<Stretch>& out)
        : map_(map),
          mesh_(map.half_edges),
          p_(p),
          q_(q),
          end_(end),
          out_(out),
          longest_(out.size() + 2 * static_cast<std::size_t>(mesh_.count()) + 2) {}

    /// Appends the stretches of p -> q and returns the place of q.
    Place run(Place start) {
        Place here = start;
        for (bool done = false; !done;) {
            entry_ = -1;
            switch (here.on) {
                case On::Vertex:
                    done = leave_vertex(here.index);
                    break;
                case On::Edge:
                    done = leave_edge(here.index);
                    break;
                case On::Face:
                    done = leave_face(here.index);
                    break;
            }
            while (!done && entry_ >= 0) done = cross_face(entry_);
            here = out_.back().stop;
        }
        if (here.on == On::Edge) here.index = mesh_.edge(here.index);
        return here;
    }

private:
    Ray ray(int v) const { return map_.ray(v); }
    int side(int x) const { return orientation(p_, q_, ray(x)); }
    /// Sign of q against half-edge h, where p -> q heads for h from within its triangle: +1 if q lies before
    /// it.
    int end_side(int h) const {
        if (end_.known() && end_.on == On::Face) return HalfEdgeTable::face(h) == end_.index ? 1 : -1;
        return orientation(ray(mesh_.from(h)), ray(mesh_.to(h)), q_);
    }

    [[noreturn]] static void outside() {
        throw SolverFailure(
            "overlay: an edge of one map leaves the other: the maps do not cover the same domain");
    }

    void stop(int left, int right, On on, int index) {
        if (out_.size() == longest_) outside();  // round and round in maps that are not one-to-one
        out_.push_back({left, right, {on, index}});
    }

    /// From vertex v, either along an edge or into a triangle. Returns true at q.
    bool leave_vertex(int v) {
        const int first = mesh_.outgoing(v);
        int h = first;
        do {
            const int last = HalfEdgeTable::prev(h);  // the other side of the wedge, from w to v
            const int s = orientation(ray(v), ray(mesh_.to(h)), q_);
            if (s == 0 && orientation(ray(v), q_, ray(mesh_.from(last))) > 0) return run_along(h, true);
            if (s > 0) {
                const int s_last = orientation(ray(v), ray(mesh_.from(last)), q_);
                if (s_last == 0) return run_along(last, false);
                if (s_last < 0) return leave_through(HalfEdgeTable::next(h));
            }
            h = mesh_.turn(h);
        } while (h >= 0 && h != first);
        outside();
    }

    /// From the inside of the edge of h, either along it or into one of its triangles.
    bool leave_edge(int h) {
        const int s = orientation(ray(mesh_.from(h)), ray(mesh_.to(h)), q_);
        if (s == 0) {
            const bool forward =
                side(mesh_.apex(h)) > 0;  // p x q and u x v are parallel; w tells their signs apart
            return run_along(h, forward);
        }
        if (s < 0) h = mesh_.opposite(h);
        if (h < 0) outside();
        return cross_face(h);
    }

    /// From the inside of a triangle.
    bool leave_face(int face) {
        if (end_.on == On::Face && end_.index == face) {
            stop(face, face, On::Face, face);
            return true;
        }
        const int h = 3 * face;
        const int s[3] = {side(mesh_.from(h)), side(mesh_.from(h + 1)), side(mesh_.from(h + 2))};
        for (int k = 0; k < 3; ++k) {
            if (s[(k + 1) % 3] <= 0) continue;
            if (s[k] < 0) return leave_through(h + k);
            if (s[k] == 0 && s[(k + 2) % 3] < 0) return leave_by_vertex(h + k);
        }
        outside();
    }

    /// Through the triangle of h, entered by crossing h: its start is left of p -> q, its end right.
    bool cross_face(int h) {
        const int s = side(mesh_.apex(h));
        if (s > 0) return leave_through(HalfEdgeTable::next(h));
        if (s < 0) return leave_through(HalfEdgeTable::prev(h));
        return leave_by_vertex(HalfEdgeTable::prev(h));
    }

    /// The segment heads for the inside of h, from within its triangle.
    bool leave_through(int h) {
        const int s = end_side(h), face = HalfEdgeTable::face(h);
        if (s > 0) {
            stop(face, face, On::Face, face);
            return true;
        }
        stop(face, face, On::Edge, h);
        if (s == 0) return true;
        entry_ = mesh_.opposite(h);
        if (entry_ < 0) outside();
        return false;
    }

    /// The segment heads for the start of h, from within its triangle.
    bool leave_by_vertex(int h) {
        const int s = end_side(h), face = HalfEdgeTable::face(h);
        entry_ = -1;
        if (s > 0) {
            stop(face, face, On::Face, face);
            return true;
        }
        stop(face, face, On::Vertex, mesh_.from(h));
        return s == 0;
    }

    /// The segment runs along h, or against it.
    bool run_along(int h, bool forward) {
        // q lies before the end of h iff det[q to w] has the sign of det[from to w].
        const int here = HalfEdgeTable::face(h), across = mesh_.face_across(h);
        const int head = forward ? mesh_.to(h) : mesh_.from(h);
        const int s = orientation(q_, ray(head), ray(mesh_.apex(h))) * (forward ? 1 : -1);
        stop(forward ? here : across, forward ? across : here, s > 0 ? On::Edge : On::Vertex,
             s > 0 ? h : head);
        return s >= 0;
    }

    const MapView& map_;
    const HalfEdgeTable& mesh_;
    const Ray p_, q_;
    const Place end_;
    std::vector<Stretch>& out_;
    const std::size_t longest_;
    int entry_ = -1;  ///< the half-edge by which the next triangle is entered, if an edge was crossed
};

std::optional<Place> place_in_triangle(const MapView& map, int face, const Ray& point) {
    const HalfEdgeTable& mesh = map.half_edges;
    int zeros = 0, zero[2] = {-1, -1};
    for (int h = 3 * face; h < 3 * face + 3; ++h) {
        const int s = orientation(map.ray(mesh.from(h)), map.ray(mesh.to(h)), point);
        if (s < 0) return std::nullopt;
        if (s == 0 && zeros < 2) zero[zeros++] = h;
    }
    if (zeros == 0) return Place{On::Face, face};
    if (zeros == 1) return Place{On::Edge, mesh.edge(zero[0])};
    return Place{On::Vertex, mesh.to(HalfEdgeTable::next(zero[0]) == zero[1] ? zero[0] : zero[1])};
}

}  // namespace

Place locate(const MapView& map, const Ray& point) {
    for (int f = 0; f < map.half_edges.face_count(); ++f) {
        if (const auto place = place_in_triangle(map, f, point)) return *place;
    }
    throw SolverFailure(fmt::format("overlay: no triangle of the map contains the ray ({}, {}, {})",
                                    point.x(), point.y(), point.z()));
}

Place walk(const MapView& map, const Ray& p, const Ray& q, Place start, Place end,
           std::vector<Stretch>& out) {
    const Place found = Walker(map, p, q, end, out).run(start);
    if (end.known() && found != end) {
        throw SolverFailure(
            "overlay: a vertex of a map is reached at two places: the maps are not one-to-one on the same "
            "domain");
    }
    return found;
}

EdgeTraces trace_edges(const MapView& traced, const MapView& through, int seed_vertex, Place seed_place) {
    const HalfEdgeTable& mesh = traced.half_edges;
    const auto edges = static_cast<std::size_t>(mesh.vertex_count() + mesh.face_count());
    EdgeTraces result;
    result.place.resize(static_cast<std::size_t>(mesh.vertex_count()));
    result.traces.reserve(edges);
    result.stretches.reserve(4 * edges);
    result.place[static_cast<std::size_t>(seed_vertex)] = seed_place;
    spread(mesh, seed_vertex, [&](int h) {
        const auto from = static_cast<std::size_t>(mesh.from(h)), to = static_cast<std::size_t>(mesh.to(h));
        const auto begin = static_cast<int>(result.stretches.size());
        result.place[to] = walk(through, traced.ray(mesh.from(h)), traced.ray(mesh.to(h)), result.place[from],
                                result.place[to], result.stretches);
        result.traces.push_back({h, begin, static_cast<int>(result.stretches.size())});
    });
    return result;
}

}  // namespace automorph
