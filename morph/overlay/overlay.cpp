#include "morph/overlay/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "morph/mesh/errors.h"
#include "morph/overlay/trace.h"

// Notation: ea, fa, va are an edge, a triangle, a vertex of map a; x is a merged vertex.
// Every merged face is the intersection of one triangle fa with one triangle fb, hence convex and connected.
// So no angular sorting is needed: each piece of an edge knows the pair (fa, fb) on its left, and the pieces
// with the same pair are the sides of one merged face.

namespace automorph {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using On = Place::On;

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

/// A side of a merged face, running from x to y with the face on its left.
struct Side {
    int fa, fb;
    int from, to;
};

/// Edges ea and eb cross at a merged vertex.
struct Crossing {
    int ea, eb;
    int vertex;
};

int left_face(const Connectivity& topology, int halfedge) {
    return topology.face_handle(HalfedgeHandle(halfedge)).idx();  // -1 outside the border
}

/// The two maps' common border: a border vertex of a and the vertex of b at the same place, or nothing if
/// both are closed.
struct SharedBorderVertex {
    int a, b;
};

std::vector<int> border(const Connectivity& topology) {
    std::vector<int> vertices;
    for (const auto h : topology.halfedges()) {
        if (topology.is_boundary(HalfedgeHandle(h.idx())))
            vertices.push_back(topology.from_vertex_handle(h).idx());
    }
    return vertices;
}

/// @throws SolverFailure if the borders are not the same set of rays
std::optional<SharedBorderVertex> match_borders(const MapView& a, const MapView& b) {
    std::vector<int> of_a = border(a.topology), of_b = border(b.topology);
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

/// Gathers the merged vertices and the sides of the merged faces.
class Merger {
public:
    Merger(const MapView& a, const MapView& b) : a_(a), b_(b) {
        if (const auto shared = match_borders(a, b)) {
            in_a_ = trace_edges(b, a, shared->b, {On::Vertex, shared->a});
            in_b_ = trace_edges(a, b, shared->a, {On::Vertex, shared->b});
        } else {
            in_a_ = trace_edges(b, a, 0, locate(a, b.ray(0)));
            in_b_ = trace_edges(a, b, 0, locate(b, a.ray(0)));
        }
    }

    Overlay run() {
        number_vertices();
        collect_sides();
        link_faces();
        return std::move(result_);
    }

private:
    // --- merged vertices: those of a, those of b that are not on one of a, the crossings ---

    void number_vertices() {
        const int na = static_cast<int>(a_.topology.n_vertices()),
                  nb = static_cast<int>(b_.topology.n_vertices());
        result_.vertex_of_a.resize(at(na));
        result_.vertex_of_b.resize(at(nb));
        std::iota(result_.vertex_of_a.begin(), result_.vertex_of_a.end(), 0);
        result_.on_a.reserve(at(na + nb));
        result_.on_b.reserve(at(na + nb));
        for (int v = 0; v < na; ++v) {
            result_.on_a.push_back(vertex_site(v));
            result_.on_b.push_back(site(b_, in_b_.place[at(v)], a_.ray(v)));
            result_.on_edges += in_b_.place[at(v)].on == On::Edge;
        }
        for (int v = 0; v < nb; ++v) {
            const Place place = in_a_.place[at(v)];
            if (place.on == On::Vertex) {
                result_.vertex_of_b[at(v)] = place.index;
                ++result_.coincident;
                continue;
            }
            result_.vertex_of_b[at(v)] = result_.vertex_count();
            result_.on_a.push_back(site(a_, place, b_.ray(v)));
            result_.on_b.push_back(vertex_site(v));
            result_.on_edges += place.on == On::Edge;
        }
        number_crossings();
    }

    /// Numbers the crossings and files them by edge of a; within one, edges of b ascend.
    void number_crossings() {
        std::vector<Crossing> found;
        for (int eb = 0; eb < static_cast<int>(in_a_.of_edge.size()); ++eb) {
            const auto& trace = in_a_.of_edge[at(eb)];
            for (int i = trace.begin; i + 1 < trace.end; ++i) {  // the last stop is the edge's own end
                const Place stop = in_a_.stretches[at(i)].stop;
                if (stop.on == On::Edge) found.push_back({stop.index, eb, 0});
            }
        }
        result_.crossings = static_cast<int>(found.size());
        result_.on_a.reserve(result_.on_a.size() + found.size());
        result_.on_b.reserve(result_.on_b.size() + found.size());
        first_crossing_.assign(a_.topology.n_edges() + 1, 0);
        for (const Crossing& x : found) ++first_crossing_[at(x.ea) + 1];
        std::partial_sum(first_crossing_.begin(), first_crossing_.end(), first_crossing_.begin());
        crossings_.resize(found.size());
        std::vector<int> next(first_crossing_.begin(), first_crossing_.end() - 1);
        for (Crossing& x : found) {
            x.vertex = result_.vertex_count();
            add_crossing_sites(x.ea, x.eb);
            crossings_[at(next[at(x.ea)]++)] = x;
        }
    }

    int merged_crossing(int ea, int eb) const {
        const auto begin = crossings_.begin() + first_crossing_[at(ea)];
        const auto end = crossings_.begin() + first_crossing_[at(ea) + 1];
        const auto found =
            std::lower_bound(begin, end, eb, [](const Crossing& x, int e) { return x.eb < e; });
        if (found == end || found->eb != eb) {
            throw SolverFailure(
                fmt::format("overlay: edges {} and {} cross in one direction of tracing only", ea, eb));
        }
        return found->vertex;
    }

    /// Edge a0 a1 meets p q at t = s0 / (s0 - s1), s = det[p q a]: [CLOSED_SHAPES] the same t lifts to 3D.
    static Site crossing_site(const MapView& map, int edge, const Ray& p, const Ray& q) {
        const HalfedgeHandle h(2 * edge);
        const int v0 = map.topology.from_vertex_handle(h).idx(), v1 = map.topology.to_vertex_handle(h).idx();
        const double s0 = determinant(p, q, map.ray(v0)), s1 = determinant(p, q, map.ray(v1));
        return {{v0, v1, -1},
                {s1 / (s1 - s0), s0 / (s0 - s1), 0.0},
                2};  // 1 - t would lose the digits of a small weight
    }

    void add_crossing_sites(int ea, int eb) {
        const auto ray = [](const MapView& map, int halfedge) {
            return map.ray(map.topology.to_vertex_handle(HalfedgeHandle(halfedge)).idx());
        };
        result_.on_a.push_back(crossing_site(a_, ea, ray(b_, 2 * eb + 1), ray(b_, 2 * eb)));
        result_.on_b.push_back(crossing_site(b_, eb, ray(a_, 2 * ea + 1), ray(a_, 2 * ea)));
    }

    static Site vertex_site(int v) { return {{v, -1, -1}, {1.0, 0.0, 0.0}, 1}; }

    /// The place of a ray as weights: det[x b c] : det[x c a] : det[x a b].
    static Site site(const MapView& map, Place place, const Ray& x) {
        const Connectivity& topology = map.topology;
        if (place.on == On::Vertex) return vertex_site(place.index);
        HalfedgeHandle h = place.on == On::Face ? topology.halfedge_handle(FaceHandle(place.index))
                                                : HalfedgeHandle(2 * place.index);
        if (topology.is_boundary(h)) h = topology.opposite_halfedge_handle(h);
        const int u = topology.from_vertex_handle(h).idx(), v = topology.to_vertex_handle(h).idx();
        const int w = topology.to_vertex_handle(topology.next_halfedge_handle(h)).idx();
        Site result{{u, v, -1},
                    {determinant(x, map.ray(v), map.ray(w)), determinant(x, map.ray(w), map.ray(u)), 0.0},
                    2};
        if (place.on == On::Face) {
            result.count = 3;
            result.corners[2] = w;
            result.weights[2] = determinant(x, map.ray(u), map.ray(v));
        }
        const double sum = result.weights[0] + result.weights[1] + result.weights[2];
        for (double& weight : result.weights) weight /= sum;
        return result;
    }

    // --- the sides of the merged faces, from both families of traces ---

    void collect_sides() {
        sides_.reserve(2 * (in_a_.stretches.size() + in_b_.stretches.size()));
        for (int e = 0; e < static_cast<int>(in_b_.of_edge.size()); ++e) sides_of_edge_of_a(e);
        for (int e = 0; e < static_cast<int>(in_a_.of_edge.size()); ++e) sides_of_edge_of_b(e);
    }

    /// Pieces of an edge of a: inside triangles of b, or along edges of b.
    void sides_of_edge_of_a(int e) {
        const auto& trace = in_b_.of_edge[at(e)];
        const int h = trace.halfedge;
        const int left = left_face(a_.topology, h), right = left_face(a_.topology, h ^ 1);
        const int head = a_.topology.to_vertex_handle(HalfedgeHandle(h)).idx();
        int x = a_.topology.from_vertex_handle(HalfedgeHandle(h)).idx();
        Progress progress;
        for (int i = trace.begin; i < trace.end; ++i) {
            const Stretch& stretch = in_b_.stretches[at(i)];
            int y = head;
            if (i + 1 < trace.end) {
                y = stretch.stop.on == On::Vertex ? result_.vertex_of_b[at(stretch.stop.index)]
                                                  : merged_crossing(e, stretch.stop.index);
            }
            const int c = stretch.carrier;
            add_sides(left, right, stretch.along ? left_face(b_.topology, c) : c,
                      stretch.along ? left_face(b_.topology, c ^ 1) : c, x, y);
            progress = keep_order(result_.on_a[at(y)], head, progress);
            x = y;
        }
    }

    /// Pieces of an edge of b inside triangles of a; those along edges of a are there already.
    void sides_of_edge_of_b(int e) {
        const auto& trace = in_a_.of_edge[at(e)];
        const int h = trace.halfedge;
        const int left = left_face(b_.topology, h), right = left_face(b_.topology, h ^ 1);
        const int head = b_.topology.to_vertex_handle(HalfedgeHandle(h)).idx();
        int x = result_.vertex_of_b[at(b_.topology.from_vertex_handle(HalfedgeHandle(h)).idx())];
        Progress progress;
        for (int i = trace.begin; i < trace.end; ++i) {
            const Stretch& stretch = in_a_.stretches[at(i)];
            int y = result_.vertex_of_b[at(head)];
            if (i + 1 < trace.end) {
                y = stretch.stop.on == On::Vertex ? stretch.stop.index
                                                  : merged_crossing(stretch.stop.index, e);
            }
            const int c = stretch.carrier;
            if (!stretch.along) add_sides(c, c, left, right, x, y);
            progress = keep_order(result_.on_b[at(y)], head, progress);
            x = y;
        }
    }

    /// Weights of a point of an edge: of the end it is traced from, and of its head.
    struct Progress {
        double tail = 1.0, head = 0.0;
    };

    /// The order of points along an edge is known exactly; rounding must not reverse it. A point that
    /// rounding puts before its predecessor takes the predecessor's weights. Compared is the smaller weight,
    /// which keeps its digits.
    static Progress keep_order(Site& site, int head, const Progress& before) {
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

    void add_sides(int left_a, int right_a, int left_b, int right_b, int x, int y) {
        if ((left_a < 0) != (left_b < 0) || (right_a < 0) != (right_b < 0)) {
            throw SolverFailure("overlay: the border of one map runs through the inside of the other");
        }
        if (left_a >= 0) sides_.push_back({left_a, left_b, x, y});
        if (right_a >= 0) sides_.push_back({right_a, right_b, y, x});
    }

    // --- faces ---

    void link_faces() {
        sort_sides();
        for (std::size_t begin = 0, end = 0; begin < sides_.size(); begin = end) {
            while (end < sides_.size() && sides_[end].fa == sides_[begin].fa &&
                   sides_[end].fb == sides_[begin].fb)
                ++end;
            result_.polygon_start.push_back(static_cast<int>(result_.polygon_vertices.size()));
            result_.face_of_a.push_back(sides_[begin].fa);
            result_.face_of_b.push_back(sides_[begin].fb);
            link_face(begin, end);
        }
        result_.polygon_start.push_back(static_cast<int>(result_.polygon_vertices.size()));
    }

    /// By (fa, fb): counting sort by fa, then the few of each fa by fb.
    void sort_sides() {
        std::vector<std::size_t> start(a_.topology.n_faces() + 1, 0);
        for (const Side& side : sides_) ++start[at(side.fa) + 1];
        std::partial_sum(start.begin(), start.end(), start.begin());
        std::vector<Side> sorted(sides_.size());
        std::vector<std::size_t> next(start.begin(), start.end() - 1);
        for (const Side& side : sides_) sorted[next[at(side.fa)]++] = side;
        for (std::size_t fa = 0; fa + 1 < start.size(); ++fa) {
            sort_few(sorted, start[fa], start[fa + 1]);
        }
        sides_ = std::move(sorted);
    }

    /// Insertion sort by fb: a triangle has some ten sides in it, nearly sorted where neighbours were traced
    /// in turn. Long ranges (one triangle over thousands) go to std::sort.
    static void sort_few(std::vector<Side>& sides, std::size_t begin, std::size_t end) {
        constexpr std::size_t kFew = 48;
        const auto before = [](const Side& x, const Side& y) {
            return x.fb != y.fb ? x.fb < y.fb : x.from < y.from;
        };
        if (end - begin > kFew) {
            std::sort(sides.begin() + static_cast<std::ptrdiff_t>(begin),
                      sides.begin() + static_cast<std::ptrdiff_t>(end), before);
            return;
        }
        for (std::size_t i = begin + 1; i < end; ++i) {
            const Side side = sides[i];
            std::size_t k = i;
            for (; k > begin && before(side, sides[k - 1]); --k) sides[k] = sides[k - 1];
            sides[k] = side;
        }
    }

    void link_face(std::size_t begin, std::size_t end) {
        int x = sides_[begin].from;
        for (std::size_t corner = begin; corner < end; ++corner) {
            result_.polygon_vertices.push_back(x);
            std::size_t side = begin;
            while (side < end && sides_[side].from != x) ++side;
            if (side == end) break;
            x = sides_[side].to;
        }
        if (x != sides_[begin].from || end - begin < 3 || end - begin > 6) {
            throw SolverFailure(fmt::format("overlay: triangles {} and {} meet in {} sides that do not close",
                                            sides_[begin].fa, sides_[begin].fb, end - begin));
        }
    }

    const MapView& a_;
    const MapView& b_;
    EdgeTraces in_a_, in_b_;           ///< edges of b through a; edges of a through b
    std::vector<Crossing> crossings_;  ///< by edge of a, then edge of b
    std::vector<int> first_crossing_;  ///< per edge of a: its range in crossings_
    std::vector<Side> sides_;
    Overlay result_;
};

}  // namespace

Overlay overlay(const Mesh& a, const Points& rays_a, const Mesh& b, const Points& rays_b) {
    const Connectivity topology_a = connectivity(a.F, a.vertex_count()),
                       topology_b = connectivity(b.F, b.vertex_count());
    const MapView map_a{topology_a, rays_a}, map_b{topology_b, rays_b};
    return Merger(map_a, map_b).run();
}

}  // namespace automorph
