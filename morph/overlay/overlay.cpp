#include "morph/overlay/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "morph/mesh/errors.h"
#include "morph/mesh/index.h"
#include "morph/overlay/merge_faces.h"
#include "morph/overlay/pieces.h"
#include "morph/overlay/trace.h"

// Notation: ea, fa, va are an edge (HalfEdgeTable::edge), a triangle, a vertex of map a; x is a merged
// vertex. Merged vertices: those of a, those of b that are not on one of a, the crossings.

namespace automorph {

namespace {

using On = Place::On;

/// The two maps' common border: a border vertex of a and the vertex of b at the same place, or nothing if
/// both are closed.
struct SharedBorderVertex {
    int a, b;
};

std::vector<int> border(const HalfEdgeTable& half_edges) {
    std::vector<int> vertices;
    for (int h = 0; h < half_edges.count(); ++h) {
        if (half_edges.opposite(h) < 0) vertices.push_back(half_edges.from(h));
    }
    return vertices;
}

/// @throws SolverFailure if the borders are not the same set of rays
std::optional<SharedBorderVertex> match_borders(const MapView& a, const MapView& b) {
    std::vector<int> of_a = border(a.half_edges), of_b = border(b.half_edges);
    if (of_a.empty() && of_b.empty()) return std::nullopt;
    const auto sorted = [](const MapView& map, std::vector<int>& vertices) {
        std::sort(vertices.begin(), vertices.end(), [&](int x, int y) {
            const Ray p = map.ray(x), q = map.ray(y);
            return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
        });
    };
    sorted(a, of_a);
    sorted(b, of_b);
    bool same = of_a.size() == of_b.size();
    for (std::size_t i = 0; same && i < of_a.size(); ++i) same = a.ray(of_a[i]) == b.ray(of_b[i]);
    if (!same) {
        throw SolverFailure(
            fmt::format("overlay: the maps have different borders ({} and {} vertices); both must have "
                        "the same polygon",
                        of_a.size(), of_b.size()));
    }
    return SharedBorderVertex{of_a.front(), of_b.front()};
}

/// Weights of a point of an edge: of the end it is traced from, and of its head.
struct Progress {
    double tail = 1.0, head = 0.0;
};

/// The order of points along an edge is known exactly; rounding must not reverse it. A point that rounding
/// puts before its predecessor takes the predecessor's weights. Compared is the smaller weight, which keeps
/// its digits.
Progress keep_order(Site& site, int head, const Progress& before) {
    if (site.count != 2) return before;
    const int k = site.corners[0] == head ? 0 : 1;
    double &here_head = site.weights[k], &here_tail = site.weights[1 - k];
    const bool reversed = before.head < 0.5 ? here_head < before.head : here_tail > before.tail;
    if (reversed) {
        here_head = before.head;
        here_tail = before.tail;
    }
    return {here_tail, here_head};
}

/// Along every edge of a map. @param sites  of the merged vertices on that map
void keep_order(const HalfEdgeTable& half_edges, const EdgePieces& of_map, std::vector<Site>& sites) {
    for (const EdgePieces::Edge& edge : of_map.edges) {
        if (edge.end - edge.begin < 3) continue;  // one point has no order
        Progress progress;
        for (int i = edge.begin; i + 1 < edge.end; ++i)
            progress = keep_order(sites[at(of_map.pieces[at(i)].to)], half_edges.to(edge.halfedge), progress);
    }
}

/// The place of a ray as weights: det[x b c] : det[x c a] : det[x a b].
Site site(const MapView& map, Place place, const Ray& x) {
    if (place.on == On::Vertex) return site_of_vertex(place.index);
    const int h = place.on == On::Face ? 3 * place.index : place.index;
    const int u = map.half_edges.from(h), v = map.half_edges.to(h), w = map.half_edges.apex(h);
    Site result{
        {u, v, -1}, {determinant(x, map.ray(v), map.ray(w)), determinant(x, map.ray(w), map.ray(u)), 0.0}, 2};
    if (place.on == On::Face) {
        result.count = 3;
        result.corners[2] = w;
        result.weights[2] = determinant(x, map.ray(u), map.ray(v));
    }
    const double sum = result.weights[0] + result.weights[1] + result.weights[2];
    for (double& weight : result.weights) weight /= sum;
    return result;
}

/// Edge v0 v1 meets p q at t = s0 / (s0 - s1), s = det[p q v]: [CLOSED_SHAPES] the same t lifts to 3D.
Site crossing_site(const MapView& map, int edge, const Ray& p, const Ray& q) {
    const int v0 = map.half_edges.from(edge), v1 = map.half_edges.to(edge);
    const double s0 = determinant(p, q, map.ray(v0)), s1 = determinant(p, q, map.ray(v1));
    // 1 - t would lose the digits of a small weight.
    return {{v0, v1, -1}, {s1 / (s1 - s0), s0 / (s0 - s1), 0.0}, 2};
}

/// Gathers the merged vertices and the pieces of all edges between them.
class Merger {
public:
    Merger(const MapView& a, const MapView& b) : a_(a), b_(b) {}

    Overlay run() {
        trace_b();
        number_vertices();
        collect_pieces_of_b();
        file_crossings();
        const EdgePieces of_a = pieces_of_a(a_, b_, result_.vertex_of_b, seed_of_a_, known_);
        place_vertices_of_a();
        keep_order(a_.half_edges, of_a, result_.on_a);
        keep_order(b_.half_edges, of_b_, result_.on_b);
        MergedFaces faces = merge_faces(a_.half_edges, of_a, b_.half_edges, of_b_);
        result_.polygon_start = std::move(faces.polygon_start);
        result_.polygon_vertices = std::move(faces.polygon_vertices);
        result_.face_of_a = std::move(faces.face_of_a);
        result_.face_of_b = std::move(faces.face_of_b);
        return std::move(result_);
    }

private:
    /// Walks b's edges through a, from a place that is known.
    void trace_b() {
        if (const auto shared = match_borders(a_, b_)) {
            seed_of_a_ = shared->a;
            in_a_ = trace_edges(b_, a_, shared->b, {On::Vertex, shared->a});
        } else {
            known_.place.assign(at(a_.half_edges.vertex_count()), {});
            known_.place[0] = locate(b_, a_.ray(0));
            in_a_ = trace_edges(b_, a_, 0, locate(a_, b_.ray(0)));
        }
    }

    void number_vertices() {
        const int na = a_.half_edges.vertex_count(), nb = b_.half_edges.vertex_count();
        const auto crossings = at(static_cast<int>(in_a_.stretches.size() - in_a_.traces.size()));
        result_.on_a.reserve(at(na + nb) + crossings);
        result_.on_b.reserve(at(na + nb) + crossings);
        result_.vertex_of_a.resize(at(na));
        result_.vertex_of_b.resize(at(nb));
        std::iota(result_.vertex_of_a.begin(), result_.vertex_of_a.end(), 0);
        known_.place.resize(at(na));
        known_.touched.assign(at(a_.half_edges.count()), 0);
        for (int v = 0; v < na; ++v) result_.on_a.push_back(site_of_vertex(v));
        result_.on_b.resize(at(na));  // until pieces_of_a has placed them
        for (int v = 0; v < nb; ++v) {
            const Place place = in_a_.place[at(v)];
            if (place.on == On::Vertex) {
                if (!place.known())
                    throw SolverFailure(fmt::format("overlay: no edge leads to vertex {} of a map", v));
                result_.vertex_of_b[at(v)] = place.index;
                known_.place[at(place.index)] = {On::Vertex, v};
                ++result_.coincident;
                continue;
            }
            result_.vertex_of_b[at(v)] = result_.vertex_count();
            result_.on_a.push_back(site(a_, place, b_.ray(v)));
            result_.on_b.push_back(site_of_vertex(v));
            if (place.on == On::Edge) {
                ++result_.on_edges;
                known_.touched[at(place.index)] = 1;
            }
        }
    }

    /// The pieces of b's edges; numbers the crossings.
    void collect_pieces_of_b() {
        of_b_.edges.reserve(in_a_.traces.size());
        of_b_.pieces.reserve(in_a_.stretches.size());
        for (const EdgeTraces::Trace& trace : in_a_.traces) {
            int x = result_.vertex_of_b[at(b_.half_edges.from(trace.halfedge))];
            for (int i = trace.begin; i < trace.end; ++i) {
                const Stretch& stretch = in_a_.stretches[at(i)];
                const int y = i + 1 < trace.end ? merged_vertex(stretch.stop, trace.halfedge)
                                                : result_.vertex_of_b[at(b_.half_edges.to(trace.halfedge))];
                of_b_.pieces.push_back({stretch.left, stretch.right, x, y});
                x = y;
            }
            of_b_.edges.push_back({trace.halfedge, trace.begin, trace.end});
        }
    }

    /// Where half-edge h of b meets a vertex or crosses an edge of a.
    int merged_vertex(Place stop, int h) {
        if (stop.on == On::Vertex) {
            known_.place[at(stop.index)] = {On::Edge, b_.half_edges.edge(h)};
            return stop.index;
        }
        const int ea = a_.half_edges.edge(stop.index), opposite = b_.half_edges.opposite(h);
        if (opposite < 0)
            throw SolverFailure("overlay: the border of one map runs through the inside of the other");
        const Ray p = b_.ray(b_.half_edges.from(h)), q = b_.ray(b_.half_edges.to(h));
        const Ray u = a_.ray(a_.half_edges.from(ea)), v = a_.ray(a_.half_edges.to(ea));
        const int vertex = result_.vertex_count();
        // h leaves the triangle of stop.index: in the direction of that half-edge, h runs from left to right.
        crossings_.push_back({ea, {stop.index == ea ? h : opposite, vertex}});
        result_.on_a.push_back(crossing_site(a_, ea, p, q));
        result_.on_b.push_back(crossing_site(b_, b_.half_edges.edge(h), v, u));
        return vertex;
    }

    /// By edge of a.
    void file_crossings() {
        result_.crossings = static_cast<int>(crossings_.size());
        known_.first.assign(at(a_.half_edges.count()) + 1, 0);
        for (const Found& x : crossings_) ++known_.first[at(x.ea) + 1];
        std::partial_sum(known_.first.begin(), known_.first.end(), known_.first.begin());
        known_.crossings.resize(crossings_.size());
        std::vector<int> next(known_.first.begin(), known_.first.end() - 1);
        for (const Found& x : crossings_) known_.crossings[at(next[at(x.ea)]++)] = x.crossing;
    }

    void place_vertices_of_a() {
        for (int v = 0; v < a_.half_edges.vertex_count(); ++v) {
            const Place place = known_.place[at(v)];
            if (!place.known())
                throw SolverFailure(fmt::format("overlay: no edge leads to vertex {} of a map", v));
            result_.on_b[at(v)] = site(b_, place, a_.ray(v));
            result_.on_edges += place.on == On::Edge;
        }
    }

    struct Found {
        int ea;
        Crossing crossing;
    };

    const MapView& a_;
    const MapView& b_;
    int seed_of_a_ = 0;
    EdgeTraces in_a_;  ///< edges of b through a
    EdgePieces of_b_;
    std::vector<Found> crossings_;  ///< in the order of tracing
    CrossingsOfA known_;
    Overlay result_;
};

}  // namespace

Overlay overlay(const Mesh& a, const Points& rays_a, const Mesh& b, const Points& rays_b) {
    const HalfEdgeTable half_edges_a(a.F, a.vertex_count()), half_edges_b(b.F, b.vertex_count());
    const MapView map_a{half_edges_a, rays_a}, map_b{half_edges_b, rays_b};
    return Merger(map_a, map_b).run();
}

}  // namespace automorph
