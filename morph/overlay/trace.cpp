#include "morph/overlay/trace.h"

#include <fmt/format.h>

#include <optional>

#include "morph/mesh/errors.h"

// Notation: the segment p -> q is walked through triangles (u, v, w); s_x = sign det[p q x] is +1 left of it.

namespace automorph {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using On = Place::On;

/// Walks one segment through a map.
class Walker {
public:
    Walker(const MapView& map, std::vector<Stretch>& out) : map_(map), topology_(map.topology), out_(out) {}

    /// Appends the stretches of p -> q and returns the place of q.
    Place walk(const Ray& p, const Ray& q, Place start) {
        p_ = p;
        q_ = q;
        Place here = start;
        const std::size_t first = out_.size(), longest = first + 2 * topology_.n_edges() + 2;
        for (bool done = false; !done;) {
            entry_ = HalfedgeHandle();
            switch (here.on) {
                case On::Vertex:
                    done = leave_vertex(here.index);
                    break;
                case On::Edge:
                    done = leave_edge(HalfedgeHandle(2 * here.index));
                    break;
                case On::Face:
                    done = leave_face(HalfedgeHandle(topology_.halfedge_handle(FaceHandle(here.index))));
                    break;
            }
            while (!done && entry_.is_valid()) done = cross_face(entry_);
            here = out_.back().stop;
            if (out_.size() > longest) outside();
        }
        return here;
    }

private:
    Ray ray(VertexHandle v) const { return map_.ray(v.idx()); }
    VertexHandle from(HalfedgeHandle h) const { return topology_.from_vertex_handle(h); }
    VertexHandle to(HalfedgeHandle h) const { return topology_.to_vertex_handle(h); }
    HalfedgeHandle next(HalfedgeHandle h) const { return topology_.next_halfedge_handle(h); }
    HalfedgeHandle prev(HalfedgeHandle h) const { return topology_.prev_halfedge_handle(h); }
    HalfedgeHandle opposite(HalfedgeHandle h) const { return topology_.opposite_halfedge_handle(h); }
    bool has_face(HalfedgeHandle h) const { return !topology_.is_boundary(h); }
    int side(VertexHandle x) const { return orientation(p_, q_, ray(x)); }
    /// Sign of q against the edge of h: +1 left of it (inside its triangle).
    int end_side(HalfedgeHandle h) const { return orientation(ray(from(h)), ray(to(h)), q_); }

    [[noreturn]] static void outside() {
        throw SolverFailure(
            "overlay: an edge of one map leaves the other: the maps do not cover the same domain");
    }

    void stop(int carrier, bool along, On on, int index) { out_.push_back({carrier, along, {on, index}}); }

    /// From vertex v, either along an edge or into a triangle. Returns true at q.
    bool leave_vertex(int vertex) {
        const VertexHandle v(vertex);
        const HalfedgeHandle first = topology_.halfedge_handle(v);
        HalfedgeHandle h = first;
        do {
            if (has_face(h)) {
                const HalfedgeHandle last = opposite(prev(h));  // the other side of the wedge
                const int s = orientation(ray(v), ray(to(h)), q_);
                if (s == 0 && orientation(ray(v), q_, ray(to(last))) > 0) return run_along(h);
                if (s > 0) {
                    const int s_last = orientation(ray(v), ray(to(last)), q_);
                    if (s_last == 0) return run_along(last);
                    if (s_last < 0) return leave_through(topology_.face_handle(h).idx(), next(h));
                }
            }
            h = opposite(prev(h));
        } while (h != first);
        outside();
    }

    /// From the inside of an edge, either along it or into one of its triangles.
    bool leave_edge(HalfedgeHandle h) {
        const int s = end_side(h);
        if (s < 0) h = opposite(h);
        if (s != 0) {
            if (!has_face(h)) outside();
            return cross_face(h);
        }
        if (!has_face(h)) h = opposite(h);
        const bool forward =
            side(to(next(h))) > 0;  // p x q and u x v are parallel; w tells their signs apart
        return run_along(forward ? h : opposite(h));
    }

    /// From the inside of the triangle of h.
    bool leave_face(HalfedgeHandle h) {
        const int face = topology_.face_handle(h).idx();
        for (int k = 0; k < 3; ++k, h = next(h)) {
            const int s_from = side(from(h)), s_to = side(to(h));
            if (s_from < 0 && s_to > 0) return leave_through(face, h);
            if (s_from == 0 && s_to > 0 && side(from(prev(h))) < 0) return leave_by_vertex(face, h);
        }
        outside();
    }

    /// Through the triangle of h, entered by crossing h: its start is left of p -> q, its end right.
    bool cross_face(HalfedgeHandle h) {
        const int face = topology_.face_handle(h).idx();
        const HalfedgeHandle right = next(h), left = prev(h);
        const int s = side(to(right));
        if (s > 0) return leave_through(face, right);
        if (s < 0) return leave_through(face, left);
        return leave_by_vertex(face, left);
    }

    /// The segment heads for the inside of h, from within `face`.
    bool leave_through(int face, HalfedgeHandle h) {
        const int s = end_side(h);
        const int edge = topology_.edge_handle(h).idx();
        if (s > 0) {
            stop(face, false, On::Face, face);
            return true;
        }
        stop(face, false, On::Edge, edge);
        if (s == 0) return true;
        entry_ = opposite(h);
        if (!has_face(entry_)) outside();
        return false;
    }

    /// The segment heads for the start of h, from within `face`.
    bool leave_by_vertex(int face, HalfedgeHandle h) {
        const int s = end_side(h);
        entry_ = HalfedgeHandle();
        if (s > 0) {
            stop(face, false, On::Face, face);
            return true;
        }
        stop(face, false, On::Vertex, from(h).idx());
        return s == 0;
    }

    /// The segment runs along h.
    bool run_along(HalfedgeHandle h) {
        // q lies before the end of h iff det[q to w] has the sign of det[from to w].
        const bool left = has_face(h);
        const VertexHandle w = to(next(left ? h : opposite(h)));
        const int s = orientation(q_, ray(to(h)), ray(w)) * (left ? 1 : -1);
        if (s > 0) {
            stop(h.idx(), true, On::Edge, topology_.edge_handle(h).idx());
            return true;
        }
        stop(h.idx(), true, On::Vertex, to(h).idx());
        return s == 0;
    }

    const MapView& map_;
    const Connectivity& topology_;
    std::vector<Stretch>& out_;
    Ray p_, q_;
    HalfedgeHandle entry_;  ///< the half-edge by which the next triangle is entered, if an edge was crossed
};

std::optional<Place> place_in_triangle(const MapView& map, FaceHandle f, const Ray& point) {
    const HalfedgeHandle h = map.topology.halfedge_handle(f);
    HalfedgeHandle zero[2];
    int zeros = 0;
    HalfedgeHandle g = h;
    for (int k = 0; k < 3; ++k, g = map.topology.next_halfedge_handle(g)) {
        const int s = orientation(map.ray(map.topology.from_vertex_handle(g).idx()),
                                  map.ray(map.topology.to_vertex_handle(g).idx()), point);
        if (s < 0) return std::nullopt;
        if (s == 0 && zeros < 2) zero[zeros++] = g;
    }
    if (zeros == 0) return Place{On::Face, f.idx()};
    if (zeros == 1) return Place{On::Edge, map.topology.edge_handle(zero[0]).idx()};
    const bool consecutive = map.topology.next_halfedge_handle(zero[0]) == zero[1];
    return Place{On::Vertex, map.topology.to_vertex_handle(consecutive ? zero[0] : zero[1]).idx()};
}

}  // namespace

Place locate(const MapView& map, const Ray& point) {
    for (int f = 0; f < static_cast<int>(map.topology.n_faces()); ++f) {
        if (const auto place = place_in_triangle(map, FaceHandle(f), point)) return *place;
    }
    throw SolverFailure(fmt::format("overlay: no triangle of the map contains the ray ({}, {}, {})",
                                    point.x(), point.y(), point.z()));
}

EdgeTraces trace_edges(const MapView& traced, const MapView& through, int seed_vertex, Place seed_place) {
    const Connectivity& topology = traced.topology;
    EdgeTraces result;
    result.of_edge.resize(topology.n_edges());
    result.place.resize(topology.n_vertices());
    result.stretches.reserve(4 * topology.n_edges());
    Walker walker(through, result.stretches);

    std::vector<int> queue{seed_vertex};
    queue.reserve(topology.n_vertices());
    result.place[static_cast<std::size_t>(seed_vertex)] = seed_place;
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const VertexHandle v(queue[next]);
        for (auto out = topology.cvoh_begin(v); out.is_valid(); ++out) {
            const HalfedgeHandle h = *out;
            auto& trace = result.of_edge[static_cast<std::size_t>(topology.edge_handle(h).idx())];
            if (trace.halfedge >= 0) continue;
            const int u = topology.to_vertex_handle(h).idx();
            trace.halfedge = h.idx();
            trace.begin = static_cast<int>(result.stretches.size());
            const Place end = walker.walk(traced.ray(v.idx()), traced.ray(u),
                                          result.place[static_cast<std::size_t>(v.idx())]);
            trace.end = static_cast<int>(result.stretches.size());
            Place& known = result.place[static_cast<std::size_t>(u)];
            if (known.index < 0) {
                known = end;
                queue.push_back(u);
            } else if (known != end) {
                throw SolverFailure(
                    fmt::format("overlay: vertex {} of a map is reached at two places: the maps are not "
                                "one-to-one on the same domain",
                                u));
            }
        }
    }
    return result;
}

}  // namespace automorph
