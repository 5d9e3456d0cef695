#include "morph/cut/cut.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/index.h"

namespace automorph {

namespace {

using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;

/// Signed distances of the vertices from the plane, nudged into the middle of the widest gap between vertices
/// within kPlaneNudge. No distance is 0.
Eigen::VectorXd clear_distances(const Mesh& mesh, const Plane& plane) {
    Eigen::VectorXd distance = (mesh.V * plane.normal).array() - plane.offset;
    const double reach = kPlaneNudge * bounding_box_diagonal(mesh.V);
    std::vector<double> near{-reach, reach};
    for (const double d : distance) {
        if (std::abs(d) < reach) near.push_back(d);
    }
    if (near.size() == 2) return distance;
    std::sort(near.begin(), near.end());
    // A plane laid through one vertex has two gaps of one width: not rounding is to choose between them.
    const double tie = 1e-3 * reach;
    std::size_t widest = 0;
    for (std::size_t i = 1; i + 1 < near.size(); ++i) {
        if (near[i + 1] - near[i] > near[widest + 1] - near[widest] + tie) widest = i;
    }
    const double shift = 0.5 * (near[widest] + near[widest + 1]);
    distance.array() -= shift;
    return (distance.array() == 0.0).select(reach * 1e-12, distance);
}

/// The half-edge of a triangle by which the cut enters it: from above to below; invalid if the plane misses
/// it.
HalfedgeHandle entry(const Connectivity& topology, const Eigen::VectorXd& distance, FaceHandle f) {
    HalfedgeHandle h = topology.halfedge_handle(f);
    for (int k = 0; k < 3; ++k, h = topology.next_halfedge_handle(h)) {
        const double from = distance[topology.from_vertex_handle(h).idx()],
                     to = distance[topology.to_vertex_handle(h).idx()];
        if (from > 0.0 && to < 0.0) return h;
    }
    return HalfedgeHandle();
}

/// The half-edge by which the cut leaves the triangle of `in`: from below to above.
HalfedgeHandle leave(const Connectivity& topology, const Eigen::VectorXd& distance, HalfedgeHandle in) {
    const HalfedgeHandle next = topology.next_halfedge_handle(in);
    return distance[topology.to_vertex_handle(next).idx()] > 0.0 ? next : topology.next_halfedge_handle(next);
}

/// Closed curves of the cut as half-edges from below to above, with the upper side on the left.
std::vector<std::vector<HalfedgeHandle>> cut_curves(const Connectivity& topology,
                                                    const Eigen::VectorXd& distance) {
    std::vector<std::vector<HalfedgeHandle>> curves;
    std::vector<char> seen(topology.n_faces(), 0);
    for (int f = 0; f < static_cast<int>(topology.n_faces()); ++f) {
        HalfedgeHandle in = seen[at(f)] ? HalfedgeHandle() : entry(topology, distance, FaceHandle(f));
        if (!in.is_valid()) continue;
        curves.emplace_back();
        while (!seen[at(topology.face_handle(in).idx())]) {
            seen[at(topology.face_handle(in).idx())] = 1;
            const HalfedgeHandle out = leave(topology, distance, in);
            curves.back().push_back(out);
            in = topology.opposite_halfedge_handle(out);
        }
    }
    return curves;
}

CutMesh::CutPoint cut_point(const Connectivity& topology, const Eigen::VectorXd& distance, HalfedgeHandle h) {
    const int from = topology.from_vertex_handle(h).idx(), to = topology.to_vertex_handle(h).idx();
    return {from, to, distance[from] / (distance[from] - distance[to])};
}

Eigen::RowVector3d position(const Mesh& mesh, const CutMesh::CutPoint& point) {
    return (1.0 - point.ratio) * mesh.V.row(point.from) + point.ratio * mesh.V.row(point.to);
}

/// Gathers one half: the vertices of one side, then the cut points, then its triangles.
class HalfBuilder {
public:
    HalfBuilder(const Mesh& mesh, const Eigen::VectorXd& distance,
                const std::vector<CutMesh::CutPoint>& points, double side)
        : mesh_(mesh), distance_(distance), side_(side), vertex_(at(mesh.vertex_count()), -1) {
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            if (!is_mine(v)) continue;
            vertex_[at(v)] = static_cast<int>(half_.vertex.size());
            half_.vertex.push_back(v);
        }
        first_cut_ = static_cast<int>(half_.vertex.size());
        for (int k = 0; k < static_cast<int>(points.size()); ++k) half_.vertex.push_back(-1 - k);
        half_.mesh.V.resize(static_cast<Eigen::Index>(half_.vertex.size()), 3);
        for (int i = 0; i < first_cut_; ++i) half_.mesh.V.row(i) = mesh.V.row(half_.vertex[at(i)]);
        for (int k = 0; k < static_cast<int>(points.size()); ++k)
            half_.mesh.V.row(first_cut_ + k) = position(mesh, points[at(k)]);
    }

    /// @param point_of_edge  per edge of the input: its cut point, or -1
    Half build(const Connectivity& topology, const std::vector<int>& point_of_edge) {
        for (int f = 0; f < static_cast<int>(topology.n_faces()); ++f)
            add_part(topology, point_of_edge, FaceHandle(f));
        half_.mesh.F.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
        for (std::size_t i = 0; i < triangles_.size(); ++i)
            half_.mesh.F.row(static_cast<Eigen::Index>(i)) = triangles_[i];
        return std::move(half_);
    }

    int cut_vertex(int point) const { return first_cut_ + point; }

private:
    bool is_mine(int v) const { return distance_[v] * side_ > 0.0; }

    /// The part of a triangle on this side: nothing, the triangle, a corner of it, or a quad.
    void add_part(const Connectivity& topology, const std::vector<int>& point_of_edge, FaceHandle f) {
        int polygon[4], corners = 0;
        HalfedgeHandle h = topology.halfedge_handle(f);
        for (int k = 0; k < 3; ++k, h = topology.next_halfedge_handle(h)) {
            const int v = topology.from_vertex_handle(h).idx();
            if (is_mine(v)) polygon[corners++] = vertex_[at(v)];
            const int point = point_of_edge[at(topology.edge_handle(h).idx())];
            if (point >= 0) polygon[corners++] = cut_vertex(point);
        }
        if (corners == 3) triangles_.push_back({polygon[0], polygon[1], polygon[2]});
        if (corners == 4) add_quad(polygon);
    }

    void add_quad(const int (&q)[4]) {
        const auto worst = [&](int i, int j, int k, int l) {
            return std::min(shape(q[i], q[j], q[k]), shape(q[i], q[k], q[l]));
        };
        if (worst(0, 1, 2, 3) >= worst(1, 2, 3, 0)) {
            triangles_.push_back({q[0], q[1], q[2]});
            triangles_.push_back({q[0], q[2], q[3]});
        } else {
            triangles_.push_back({q[1], q[2], q[3]});
            triangles_.push_back({q[1], q[3], q[0]});
        }
    }

    /// Area over the sum of squared sides: largest for an equilateral triangle.
    double shape(int i, int j, int k) const {
        const Eigen::Vector3d u = half_.mesh.V.row(j) - half_.mesh.V.row(i),
                              v = half_.mesh.V.row(k) - half_.mesh.V.row(i);
        const double sides = u.squaredNorm() + v.squaredNorm() + (u - v).squaredNorm();
        return sides > 0.0 ? u.cross(v).norm() / sides : 0.0;
    }

    const Mesh& mesh_;
    const Eigen::VectorXd& distance_;
    double side_;
    std::vector<int> vertex_;  ///< per vertex of the input: its vertex in the half, or -1
    int first_cut_ = 0;
    std::vector<Eigen::RowVector3i> triangles_;
    Half half_;
};

}  // namespace

Section section(const Mesh& mesh, const Connectivity& topology, const Plane& plane) {
    const Eigen::VectorXd distance = clear_distances(mesh, plane);
    Section result;
    for (const auto& curve : cut_curves(topology, distance)) {
        ++result.loops;
        Eigen::RowVector3d before = position(mesh, cut_point(topology, distance, curve.back()));
        for (const HalfedgeHandle h : curve) {
            const Eigen::RowVector3d here = position(mesh, cut_point(topology, distance, h));
            result.length += (here - before).norm();
            before = here;
        }
    }
    const Eigen::VectorXd areas = vertex_areas(mesh);
    result.area_above = (distance.array() > 0.0).select(areas, 0.0).sum();
    result.area_below = areas.sum() - result.area_above;
    return result;
}

CutMesh cut(const Mesh& mesh, const Plane& plane) {
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    const Eigen::VectorXd distance = clear_distances(mesh, plane);
    const auto curves = cut_curves(topology, distance);
    if (curves.size() != 1) {
        throw SolverFailure(fmt::format(
            "cut: the plane meets the mesh in {} closed curves; two disks need exactly one", curves.size()));
    }
    CutMesh result;
    std::vector<int> point_of_edge(topology.n_edges(), -1);
    for (const HalfedgeHandle h : curves[0]) {
        point_of_edge[at(topology.edge_handle(h).idx())] = static_cast<int>(result.points.size());
        result.points.push_back(cut_point(topology, distance, h));
    }
    const int n = static_cast<int>(result.points.size());
    for (const int which : {0, 1}) {
        HalfBuilder builder(mesh, distance, result.points, which == 0 ? 1.0 : -1.0);
        std::vector<int> loop;
        for (int k = 0; k < n; ++k) loop.push_back(builder.cut_vertex(which == 0 ? k : (n - k) % n));
        result.halves[at(which)] = builder.build(topology, point_of_edge);
        result.halves[at(which)].loop = std::move(loop);
    }
    return result;
}

}  // namespace automorph
