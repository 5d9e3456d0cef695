#include "morph/mesh/geometry.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace automorph {

namespace {

Eigen::Vector3d corner(const Mesh& mesh, int triangle, int k) {
    return mesh.V.row(mesh.F(triangle, k));
}

Eigen::Vector3d area_vector(const Mesh& mesh, int f) {
    return 0.5 * doubled_area_vector(mesh.V, mesh.F, f);
}

}  // namespace

double bounding_box_diagonal(const Points& V) {
    if (V.rows() == 0) return 0.0;
    return (V.colwise().maxCoeff() - V.colwise().minCoeff()).norm();
}

UnitFrame::UnitFrame(const Points& V) {
    const Eigen::RowVector3d low = V.colwise().minCoeff(), high = V.colwise().maxCoeff();
    centre = 0.5 * (low + high);
    size = std::max((high - low).norm(), std::numeric_limits<double>::min());
}

Eigen::Vector3d doubled_area_vector(const Points& V, const Triangles& F, Eigen::Index f) {
    const Eigen::Vector3d p = V.row(F(f, 0)), q = V.row(F(f, 1)), r = V.row(F(f, 2));
    return (q - p).cross(r - p);
}

double longest_edge(const Points& V, const Triangles& F, Eigen::Index f) {
    const Eigen::Vector3d p = V.row(F(f, 0)), q = V.row(F(f, 1)), r = V.row(F(f, 2));
    return std::max({(q - p).norm(), (r - q).norm(), (p - r).norm()});
}

Eigen::VectorXd triangle_areas(const Mesh& mesh) {
    Eigen::VectorXd areas(mesh.triangle_count());
    for (int f = 0; f < mesh.triangle_count(); ++f) areas[f] = area_vector(mesh, f).norm();
    return areas;
}

Eigen::Vector3d centre_of_mass(const Mesh& mesh) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double total = 0.0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const double area = area_vector(mesh, f).norm();
        sum += area / 3.0 * (corner(mesh, f, 0) + corner(mesh, f, 1) + corner(mesh, f, 2));
        total += area;
    }
    if (total > 0.0) return sum / total;
    return mesh.V.rows() > 0 ? Eigen::Vector3d(mesh.V.colwise().mean()) : Eigen::Vector3d::Zero();
}

Eigen::VectorXd vertex_areas(const Mesh& mesh) {
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(mesh.vertex_count());
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const double third = area_vector(mesh, f).norm() / 3.0;
        for (int k = 0; k < 3; ++k) areas[mesh.F(f, k)] += third;
    }
    return areas;
}

Points vertex_normals(const Mesh& mesh) {
    Points normals = Points::Zero(mesh.vertex_count(), 3);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const Eigen::Vector3d n = area_vector(mesh, f);
        const double length = n.norm();
        if (!(length > 0.0)) continue;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d p = corner(mesh, f, k);
            const Eigen::Vector3d u = corner(mesh, f, (k + 1) % 3) - p, v = corner(mesh, f, (k + 2) % 3) - p;
            const double angle = std::atan2(u.cross(v).norm(), u.dot(v));
            normals.row(mesh.F(f, k)) += (angle / length) * n.transpose();
        }
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double length = normals.row(v).norm();
        if (length > 0.0) normals.row(v) /= length;
    }
    return normals;
}

Points area_weighted_normals(const Points& V, const Triangles& F) {
    Points normals = Points::Zero(V.rows(), 3);
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        const Eigen::Vector3d area = doubled_area_vector(V, F, f);
        for (int k = 0; k < 3; ++k) normals.row(F(f, k)) += area.transpose();
    }
    for (Eigen::Index v = 0; v < V.rows(); ++v) normals.row(v).stableNormalize();
    return normals;
}

double signed_volume(const Mesh& mesh) {
    const Eigen::Vector3d origin = centre_of_mass(mesh);
    double volume = 0.0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        volume += area_vector(mesh, f).dot(corner(mesh, f, 0) - origin) / 3.0;
    }
    return volume;
}

}  // namespace automorph
