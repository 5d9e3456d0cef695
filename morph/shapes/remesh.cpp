#include "morph/shapes/remesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <vector>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/shapes/random.h"

namespace automorph {

namespace {

using Vector = Eigen::Vector3d;
using Edge = OpenMesh::EdgeHandle;
using Face = OpenMesh::FaceHandle;
using Halfedge = OpenMesh::HalfedgeHandle;
using Vertex = OpenMesh::VertexHandle;

// Edge lengths relative to the wanted one; with these neither a split nor a collapse makes the other
// necessary [Botsch04].
constexpr double kLongest = 4.0 / 3.0, kShortest = 4.0 / 5.0;
// New edges of a split at most, relative to the old one; sqrt(3) / 2 for an equilateral triangle in a plane.
// Below 1, so that splitting all long edges ends.
constexpr double kSplitGain = 0.95;
// Likewise for splits and collapses that only make the count right, relative to the wanted length.
constexpr double kLongestForCount = 2.0;
constexpr int kShapingRounds = 6;    // until edge lengths are right
constexpr int kShakes = 4;           // a random walk of about 1.2 edge lengths
constexpr double kShake = 0.6;       // edge lengths
constexpr int kCountRounds = 4;      // making the count exact
constexpr int kSettlingRounds = 12;  // until the triangles are even
constexpr int kFlipPasses = 10;      // a bound only: two or three are used
// A triangle and the surface's normal at its corners may include an angle of this cosine: a fold is negative.
constexpr double kLeastUprightness = 0.2;
constexpr double kTiny = 1e-300;  // in place of zero areas as divisors
// Delaunay: cotangents of the opposite angles that add up to less are flipped; not 0, so that no edge of a
// square flips for ever.
constexpr double kDelaunay = -1e-9;

class Remesher {
public:
    Remesher(const Mesh& start, const ImplicitSurface& surface, const RemeshOptions& options)
        : surface_(surface),
          spacing_(options.spacing),
          random_(options.seed),
          topology_(connectivity(start.F, start.vertex_count())) {
        for (const auto h : topology_.halfedges()) {
            if (h.is_boundary())
                throw InvalidMesh(fmt::format("remesh: the mesh to start from is not closed"));
        }
        topology_.request_vertex_status();
        topology_.request_edge_status();
        topology_.request_face_status();
        // Euler's formula: F = 2 (V - 2 + 2 genus), and the genus stays.
        const int excess = start.vertex_count() - start.triangle_count() / 2;
        wanted_triangles_ = std::max(4, 2 * (options.triangles / 2));
        wanted_vertices_ = wanted_triangles_ / 2 + excess;
        vertex_count_ = start.vertex_count();
        for (int v = 0; v < start.vertex_count(); ++v) points_.push_back(locate(start.V.row(v)));
    }

    Mesh run() {
        for (int k = 0; k < kShapingRounds; ++k) shape();
        for (int k = 0; k < kShakes; ++k) {
            shake();
            make_delaunay();
        }
        for (int k = 0; k < kCountRounds; ++k) shape();
        for (int k = 0; k < kCountRounds; ++k) {
            match_count();
            make_delaunay();
            relax();
        }
        match_count();
        for (int k = 0; k < kSettlingRounds; ++k) {
            make_delaunay();
            relax();
        }
        make_delaunay();
        return mesh();
    }

private:
    /// One round of [Botsch04].
    void shape() {
        measure();
        split_long_edges();
        collapse_short_edges();
        make_delaunay();
        relax();
    }

    const Vector& position(Vertex v) const { return points_[static_cast<std::size_t>(v.idx())].position; }
    const Vector& normal(Vertex v) const { return points_[static_cast<std::size_t>(v.idx())].normal; }

    double spacing(Vertex v) const { return points_[static_cast<std::size_t>(v.idx())].spacing; }

    struct Sample : ImplicitPoint {
        double spacing;
    };
    Sample locate(const Vector& start) const {
        const ImplicitPoint point = project(surface_, start);
        return {point, spacing_ ? spacing_(point.position) : 1.0};
    }

    /// Distance relative to the spacing there. All lengths below are.
    static double distance(const Sample& a, const Sample& b) {
        return (a.position - b.position).norm() / (0.5 * (a.spacing + b.spacing));
    }
    double distance(Vertex a, Vertex b) const {
        return distance(points_[static_cast<std::size_t>(a.idx())],
                        points_[static_cast<std::size_t>(b.idx())]);
    }

    double length(Edge e) const {
        const Halfedge h = topology_.halfedge_handle(e, 0);
        return distance(topology_.to_vertex_handle(h), topology_.from_vertex_handle(h));
    }

    std::array<Vertex, 3> corners(Face f) const {
        const Halfedge h = topology_.halfedge_handle(f);
        return {topology_.from_vertex_handle(h), topology_.to_vertex_handle(h),
                topology_.to_vertex_handle(topology_.next_halfedge_handle(h))};
    }

    /// Cosine of the angle between a triangle and the surface's normals at its corners; negative: folded
    /// over.
    double uprightness(Vertex a, Vertex b, Vertex c) const {
        const Vector area = (position(b) - position(a)).cross(position(c) - position(a));
        const Vector sum = normal(a) + normal(b) + normal(c);
        return area.dot(sum) / std::max(area.norm() * sum.norm(), kTiny);
    }
    bool upright(Vertex a, Vertex b, Vertex c) const { return uprightness(a, b, c) > kLeastUprightness; }

    /// The least of the triangles round a vertex.
    double uprightness(Vertex v) const {
        double least = 1.0;
        for (const auto spoke : topology_.voh_range(v)) {
            const Vertex a = topology_.to_vertex_handle(spoke);
            const Vertex b = topology_.to_vertex_handle(topology_.next_halfedge_handle(spoke));
            least = std::min(least, uprightness(v, a, b));
        }
        return least;
    }

    /// The relative edge length of equilateral triangles of the wanted number on the present area.
    void measure() {
        double area = 0.0;
        for (const auto f : topology_.faces()) {
            const auto [a, b, c] = corners(f);
            const double mean = (spacing(a) + spacing(b) + spacing(c)) / 3.0;
            area += 0.5 * (position(b) - position(a)).cross(position(c) - position(a)).norm() / (mean * mean);
        }
        length_ = std::sqrt(4.0 * area / (std::sqrt(3.0) * wanted_triangles_));
    }

    /// Halves an edge unless one of the four new ones would be longer than `longest`: where the mesh is too
    /// coarse for the surface, the middle may be projected far away.
    bool split(Edge e, double longest) {
        const auto ends = diamond(e);
        const Sample middle = locate(0.5 * (position(ends[0]) + position(ends[1])));
        for (const Vertex v : ends) {
            if (distance(points_[static_cast<std::size_t>(v.idx())], middle) > longest) return false;
        }
        points_.push_back(middle);
        topology_.split(e, topology_.new_vertex());
        ++vertex_count_;
        return true;
    }

    /// Longest first: in any other order a split may leave edges longer than the one it cut, and there is no
    /// end.
    void split_long_edges() {
        std::priority_queue<std::pair<double, int>> queue;
        const auto push_if_long = [&](Edge e) {
            const double l = length(e);
            if (l > kLongest * length_) queue.emplace(l, e.idx());
        };
        for (const auto e : topology_.edges()) push_if_long(e);
        while (!queue.empty()) {
            const auto [l, index] = queue.top();
            queue.pop();
            if (length(Edge(index)) != l) continue;  // split in the meantime
            if (!split(Edge(index), kSplitGain * l)) continue;
            for (const auto e : topology_.ve_range(Vertex(static_cast<int>(points_.size()) - 1)))
                push_if_long(e);
        }
    }

    /// Moves the half-edge's first vertex into its second unless that folds a triangle, makes an edge longer
    /// than `longest` or breaks the topology.
    bool collapse(Halfedge h, double longest) {
        if (vertex_count_ <= 4) return false;
        const Vertex gone = topology_.from_vertex_handle(h), stays = topology_.to_vertex_handle(h);
        for (const auto spoke : topology_.voh_range(gone)) {
            const Vertex b = topology_.to_vertex_handle(spoke);
            const Vertex c = topology_.to_vertex_handle(topology_.next_halfedge_handle(spoke));
            if (b != stays && distance(b, stays) > longest) return false;
            if (b != stays && c != stays && !upright(stays, b, c)) return false;
        }
        if (!topology_.is_collapse_ok(h)) return false;
        topology_.collapse(h);
        --vertex_count_;
        return true;
    }

    bool collapse(Edge e, double longest) {
        return collapse(topology_.halfedge_handle(e, 0), longest) ||
               collapse(topology_.halfedge_handle(e, 1), longest);
    }

    void collapse_short_edges() {
        const int edges = static_cast<int>(topology_.n_edges());
        for (int k = 0; k < edges; ++k) {
            const Edge e(k);
            if (!topology_.status(e).deleted() && length(e) < kShortest * length_)
                collapse(e, kLongest * length_);
        }
    }

    /// The two ends of an edge, then the corners opposite to it on its left and on its right.
    std::array<Vertex, 4> diamond(Edge e) const {
        const Halfedge h = topology_.halfedge_handle(e, 0), o = topology_.halfedge_handle(e, 1);
        return {topology_.from_vertex_handle(h), topology_.to_vertex_handle(h),
                topology_.to_vertex_handle(topology_.next_halfedge_handle(h)),
                topology_.to_vertex_handle(topology_.next_halfedge_handle(o))};
    }

    bool can_flip(Edge e, const std::array<Vertex, 4>& d) const {
        return topology_.is_flip_ok(e) && upright(d[3], d[1], d[2]) && upright(d[2], d[0], d[3]);
    }

    static double cotangent(const Vector& apex, const Vector& a, const Vector& b) {
        const Vector u = a - apex, v = b - apex;
        return u.dot(v) / std::max(u.cross(v).norm(), kTiny);
    }

    /// [Botsch04] flip towards valence 6; Delaunay flips leave better triangles (least angles of 30 and 24
    /// degrees on the star).
    void make_delaunay() {
        for (int pass = 0; pass < kFlipPasses; ++pass) {
            int flips = 0;
            for (const auto e : topology_.edges()) {
                const auto d = diamond(e);
                const double sum = cotangent(position(d[2]), position(d[0]), position(d[1])) +
                                   cotangent(position(d[3]), position(d[0]), position(d[1]));
                if (sum >= kDelaunay || !can_flip(e, d)) continue;
                topology_.flip(e);
                ++flips;
            }
            if (flips == 0) return;
        }
    }

    /// Moves every vertex to the area-weighted centroid of its triangles, in the tangent plane, then to the
    /// surface.
    void relax() {
        std::vector<double> area(points_.size(), 0.0);
        std::vector<Vector> moment(points_.size(), Vector::Zero());
        for (const auto f : topology_.faces()) {
            const auto triangle = corners(f);
            const auto [a, b, c] = triangle;
            // Spacing is the -1/4th power of the density whose centroidal Voronoi cells have it.
            const double mean = (spacing(a) + spacing(b) + spacing(c)) / 3.0;
            const double weight = (position(b) - position(a)).cross(position(c) - position(a)).norm() /
                                  (mean * mean * mean * mean);
            const Vector centroid = (position(a) + position(b) + position(c)) / 3.0;
            for (const Vertex v : triangle) {
                area[static_cast<std::size_t>(v.idx())] += weight;
                moment[static_cast<std::size_t>(v.idx())] += weight * centroid;
            }
        }
        for (const auto v : topology_.vertices()) {
            const auto k = static_cast<std::size_t>(v.idx());
            if (area[k] > 0.0) move(v, moment[k] / area[k] - position(v));
        }
    }

    /// Moves every vertex by up to kShake edge lengths.
    void shake() {
        for (const auto v : topology_.vertices())
            move(v, kShake * length_ * spacing(v) * random_.in_ball<3>());
    }

    /// Moves a vertex along its tangent plane and back to the surface, unless that folds a triangle over.
    void move(Vertex v, const Vector& displacement) {
        Sample& point = points_[static_cast<std::size_t>(v.idx())];
        const Sample before = point;
        const double least =
            std::min(uprightness(v), kLeastUprightness);  // one that is folded already may unfold in steps
        point = locate(before.position + displacement - displacement.dot(before.normal) * before.normal);
        if (uprightness(v) < least) point = before;
    }

    /// Splits the longest or collapses the shortest edges until the number of vertices is the wanted one.
    void match_count() {
        while (vertex_count_ != wanted_vertices_) {
            const bool too_few = vertex_count_ < wanted_vertices_;
            std::vector<std::pair<double, int>> order;
            for (const auto e : topology_.edges())
                order.emplace_back(too_few ? -length(e) : length(e), e.idx());
            std::sort(order.begin(), order.end());
            order.resize((order.size() + 3) / 4);
            const int before = vertex_count_;
            for (const auto& [key, index] : order) {
                if (vertex_count_ == wanted_vertices_) break;
                const Edge e(index);
                if (topology_.status(e).deleted() || length(e) != std::abs(key)) continue;
                if (too_few)
                    split(e, kLongestForCount * length_);
                else
                    collapse(e, kLongestForCount * length_);
            }
            if (vertex_count_ == before) return;  // too thin for so few triangles
        }
    }

    Mesh mesh() const {
        Mesh result;
        result.V.resize(vertex_count_, 3);
        result.F.resize(std::distance(topology_.faces_sbegin(), topology_.faces_end()), 3);
        std::vector<int> index(points_.size(), -1);
        int count = 0;
        for (const auto v : topology_.vertices()) {
            result.V.row(count) = position(v).transpose();
            index[static_cast<std::size_t>(v.idx())] = count++;
        }
        count = 0;
        for (const auto f : topology_.faces()) {
            const auto triangle = corners(f);
            for (int k = 0; k < 3; ++k) {
                result.F(count, k) =
                    index[static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)].idx())];
            }
            ++count;
        }
        return result;
    }

    const ImplicitSurface& surface_;
    const std::function<double(const Vector&)>& spacing_;
    Random random_;
    Connectivity topology_;
    std::vector<Sample> points_;  // per vertex, deleted ones included
    int vertex_count_ = 0, wanted_vertices_ = 0, wanted_triangles_ = 0;
    double length_ = 0.0;  // the wanted edge length, relative to the spacing
};

}  // namespace

Mesh remesh(const Mesh& start, const ImplicitSurface& surface, const RemeshOptions& options) {
    return Remesher(start, surface, options).run();
}

}  // namespace automorph
