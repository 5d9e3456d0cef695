#include "morph/shapes/crop.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"

namespace automorph {

namespace {

using Vector = Eigen::Vector3d;
using Edge = OpenMesh::EdgeHandle;
using Vertex = OpenMesh::VertexHandle;

// A vertex within this share of its shortest edge from the border is moved onto it.
constexpr double kSnap = 0.45;
// A triangle may turn by an angle of this cosine when a corner moves.
constexpr double kLeastCosine = 0.5;
/// Sum of cotangents below which an edge is flipped: not 0, so that no edge of a square flips for ever.
constexpr double kLeastCotangents = -1e-9;

/// The point of both zero levels that Newton's method with steps of least length reaches.
Vector project_to_curve(const ImplicitSurface& surface, const ImplicitSurface& side, const Vector& start) {
    constexpr int kMaxSteps = 40;
    constexpr double kClose = 1e-13;  // of the point's size
    Vector p = start;
    for (int step = 0; step < kMaxSteps; ++step) {
        const FieldSample f = surface(p), g = side(p);
        const double ff = f.gradient.squaredNorm(), gg = g.gradient.squaredNorm(),
                     fg = f.gradient.dot(g.gradient);
        const double determinant = ff * gg - fg * fg;
        if (!(determinant > 1e-9 * ff * gg)) break;  // parallel to rounding
        const double a = (gg * f.value - fg * g.value) / determinant;
        const double b = (ff * g.value - fg * f.value) / determinant;
        const Vector move = -a * f.gradient - b * g.gradient;
        p += move;
        if (move.norm() <= kClose * (p.norm() + 1e-3)) return p;
    }
    throw SolverFailure(
        fmt::format("no border point found near ({:g} {:g} {:g}); with more triangles there is one",
                    start.x(), start.y(), start.z()));
}

class Cropper {
public:
    Cropper(const Mesh& mesh, const ImplicitSurface& surface, const ImplicitSurface& side)
        : surface_(surface), side_(side), topology_(connectivity(mesh.F, mesh.vertex_count())) {
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            points_.emplace_back(mesh.V.row(v).transpose());
            values_.push_back(side(points_.back()).value);
        }
    }

    Mesh run() {
        snap();
        split();
        flip();
        return kept();
    }

private:
    const Vector& position(Vertex v) const { return points_[static_cast<std::size_t>(v.idx())]; }
    double value(Vertex v) const { return values_[static_cast<std::size_t>(v.idx())]; }

    bool crosses(Edge e) const {
        const auto h = topology_.halfedge_handle(e, 0);
        return value(topology_.to_vertex_handle(h)) * value(topology_.from_vertex_handle(h)) < 0.0;
    }

    /// Moves vertices close to the border onto it, closest first, where no triangle folds.
    void snap() {
        std::vector<std::pair<double, int>> close;
        for (const auto v : topology_.vertices()) {
            double shortest = 1e300;
            bool is_beside = false;
            for (const auto h : topology_.voh_range(v)) {
                shortest = std::min(shortest, (position(topology_.to_vertex_handle(h)) - position(v)).norm());
                is_beside = is_beside || crosses(topology_.edge_handle(h));
            }
            // To first order; farther away there need not be a border point to find.
            const double away = std::abs(value(v)) / side_(position(v)).gradient.norm();
            if (!is_beside || away > kSnap * shortest) continue;
            const Vector target = project_to_curve(surface_, side_, position(v));
            const double distance = (target - position(v)).norm() / shortest;
            if (distance < kSnap) close.emplace_back(distance, v.idx());
        }
        std::sort(close.begin(), close.end());
        for (const auto& [distance, index] : close) {
            const Vertex v(index);
            const Vector target = project_to_curve(surface_, side_, position(v));
            if (!stays_upright(v, target)) continue;
            points_[static_cast<std::size_t>(index)] = target;
            values_[static_cast<std::size_t>(index)] = 0.0;
        }
    }

    bool stays_upright(Vertex v, const Vector& target) const {
        for (const auto h : topology_.voh_range(v)) {
            const Vector a = position(topology_.to_vertex_handle(h)),
                         b = position(topology_.to_vertex_handle(topology_.next_halfedge_handle(h)));
            const Vector before = (a - position(v)).cross(b - position(v)),
                         after = (a - target).cross(b - target);
            if (after.dot(before) <= kLeastCosine * after.norm() * before.norm()) return false;
        }
        return true;
    }

    /// Splits edges that still cross the border.
    void split() {
        const int edges = static_cast<int>(topology_.n_edges());
        for (int k = 0; k < edges; ++k) {
            const Edge e(k);
            if (!crosses(e)) continue;
            const auto h = topology_.halfedge_handle(e, 0);
            const Vertex a = topology_.from_vertex_handle(h), b = topology_.to_vertex_handle(h);
            const double t = value(a) / (value(a) - value(b));
            points_.push_back(project_to_curve(surface_, side_, (1.0 - t) * position(a) + t * position(b)));
            values_.push_back(0.0);
            topology_.split(e, topology_.new_vertex());
        }
    }

    /// Makes the triangles Delaunay again where no border edge goes and no edge crosses the border for it.
    void flip() {
        constexpr int kPasses = 4;
        const auto cotangent = [](const Vector& u, const Vector& v) {
            return u.dot(v) / std::max(u.cross(v).norm(), 1e-300);
        };
        for (int pass = 0; pass < kPasses; ++pass) {
            for (const auto e : topology_.edges()) {
                const auto h = topology_.halfedge_handle(e, 0), o = topology_.halfedge_handle(e, 1);
                const Vertex a = topology_.from_vertex_handle(h), b = topology_.to_vertex_handle(h);
                const Vertex c = topology_.to_vertex_handle(topology_.next_halfedge_handle(h)),
                             d = topology_.to_vertex_handle(topology_.next_halfedge_handle(o));
                if ((value(a) == 0.0 && value(b) == 0.0) || value(c) * value(d) < 0.0) continue;
                const Vector pa = position(a), pb = position(b), pc = position(c), pd = position(d);
                if (cotangent(pa - pc, pb - pc) + cotangent(pa - pd, pb - pd) >= kLeastCotangents) continue;
                const Vector before = (pb - pa).cross(pc - pa) + (pd - pa).cross(pb - pa);
                const Vector first = (pb - pd).cross(pc - pd), second = (pc - pd).cross(pa - pd);
                const bool is_upright = first.dot(before) > kLeastCosine * first.norm() * before.norm() &&
                                        second.dot(before) > kLeastCosine * second.norm() * before.norm();
                if (is_upright && topology_.is_flip_ok(e)) topology_.flip(e);
            }
        }
    }

    Mesh kept() const {
        std::vector<std::array<int, 3>> triangles;
        std::vector<int> index(points_.size(), -1);
        std::vector<int> order;
        for (const auto f : topology_.faces()) {
            std::array<int, 3> corners;
            std::size_t k = 0;
            double lowest = 0.0, highest = 0.0;
            for (const auto v : topology_.fv_range(f)) {
                corners[k++] = v.idx();
                lowest = std::min(lowest, value(v));
                highest = std::max(highest, value(v));
            }
            if (highest > 0.0 || lowest == 0.0) continue;
            triangles.push_back(corners);
        }
        if (triangles.empty()) throw SolverFailure("crop: nothing is left");
        Mesh mesh;
        mesh.F.resize(static_cast<Eigen::Index>(triangles.size()), 3);
        for (std::size_t f = 0; f < triangles.size(); ++f) {
            for (std::size_t k = 0; k < 3; ++k) {
                int& place = index[static_cast<std::size_t>(triangles[f][k])];
                if (place < 0) {
                    place = static_cast<int>(order.size());
                    order.push_back(triangles[f][k]);
                }
                mesh.F(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) = place;
            }
        }
        mesh.V.resize(static_cast<Eigen::Index>(order.size()), 3);
        for (std::size_t v = 0; v < order.size(); ++v)
            mesh.V.row(static_cast<Eigen::Index>(v)) =
                points_[static_cast<std::size_t>(order[v])].transpose();
        return mesh;
    }

    const ImplicitSurface& surface_;
    const ImplicitSurface& side_;
    Connectivity topology_;
    std::vector<Vector> points_;  // per vertex
    std::vector<double> values_;  // of the side, 0 on the border
};

}  // namespace

Mesh crop(const Mesh& closed, const ImplicitSurface& surface, const ImplicitSurface& side) {
    return Cropper(closed, surface, side).run();
}

}  // namespace automorph
