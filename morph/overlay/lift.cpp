#include "morph/overlay/lift.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "morph/mesh/geometry.h"

// Notation of Eq. (9)-(11): site p = sum b_i v_i, n its unit normal, d_i = v_i - p, theta_i the angle between
// n and the vertex normal n_i, beta_i the angle between n and d_i.

namespace automorph {

namespace {

using Eigen::Vector3d;

/// tan(theta / 2) at the largest angle between the normals of a site and of a corner: 60 degrees.
const double kMaxBend = std::tan(M_PI / 6.0);

Vector3d flat(const Points& V, const Site& site) {
    if (site.count == 1) return V.row(site.corners[0]);
    Vector3d p = Vector3d::Zero();
    for (int i = 0; i < site.count; ++i) p += site.weights[i] * V.row(site.corners[i]).transpose();
    return p;
}

/// alpha_i of Eq. (10). d cos(beta) is the corner's height above p along n; the root is d sin(beta) tan(theta
/// / 2).
double height_above(const Vector3d& p, const Vector3d& n, const Vector3d& v_i, const Vector3d& n_i) {
    const Vector3d d = v_i - p;
    const double along = n.dot(d);
    const double across = (d - along * n).norm();
    const double tangent = std::tan(0.5 * std::atan2(n.cross(n_i).norm(), n.dot(n_i)));
    const double sign = (n - n_i).dot(p - v_i) >= 0.0 ? 1.0 : -1.0;
    return along + sign * across * std::min(tangent, kMaxBend);
}

}  // namespace

Site compose(const Site& site, const std::vector<Site>& vertices) {
    Site result;
    for (int i = 0; i < site.count; ++i) {
        const Site& corner = vertices[static_cast<std::size_t>(site.corners[i])];
        for (int j = 0; j < corner.count; ++j) {
            const int* known = std::find(result.corners, result.corners + result.count, corner.corners[j]);
            const auto k = known - result.corners;
            if (k == result.count) {
                assert(result.count < 3 && "corners of a site lie in one triangle of the original");
                result.corners[result.count++] = corner.corners[j];
            }
            result.weights[k] += site.weights[i] * corner.weights[j];
        }
    }
    return result;
}

Points place(const Points& V, const std::vector<Site>& sites) {
    Points points(static_cast<Eigen::Index>(sites.size()), 3);
    for (std::size_t i = 0; i < sites.size(); ++i)
        points.row(static_cast<Eigen::Index>(i)) = flat(V, sites[i]);
    return points;
}

Points smooth_normals(const Mesh& mesh, double crease) {
    const double least = std::cos(crease * M_PI / 180.0);
    Points normals = vertex_normals(mesh);
    std::vector<char> sharp(static_cast<std::size_t>(mesh.vertex_count()), 0);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const Vector3d n = doubled_area_vector(mesh.V, mesh.F, f).stableNormalized();
        if (n.isZero(0.0)) continue;
        for (int k = 0; k < 3; ++k)
            sharp[static_cast<std::size_t>(mesh.F(f, k))] |= normals.row(mesh.F(f, k)).dot(n) < least;
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (sharp[static_cast<std::size_t>(v)]) normals.row(v).setZero();
    }
    return normals;
}

Points lift(const Points& V, const Points& normals, const std::vector<Site>& sites) {
    Points points = place(V, sites);
    for (std::size_t k = 0; k < sites.size(); ++k) {
        const Site& site = sites[k];
        if (site.count == 1) continue;
        const Vector3d p = points.row(static_cast<Eigen::Index>(k));
        Vector3d n = Vector3d::Zero();
        for (int i = 0; i < site.count; ++i) n += site.weights[i] * normals.row(site.corners[i]).transpose();
        if (n.isZero(0.0)) continue;
        n.normalize();
        double height = 0.0, smooth = 0.0;  // the weight of the corners that bend
        for (int i = 0; i < site.count; ++i) {
            const Vector3d n_i = normals.row(site.corners[i]);
            const bool bends = !n_i.isZero(0.0);
            height += site.weights[i] * height_above(p, n, V.row(site.corners[i]), bends ? n_i : n);
            if (bends) smooth += site.weights[i];
        }
        if (smooth < 1.0) height *= smooth * smooth;
        points.row(static_cast<Eigen::Index>(k)) += height * n;
    }
    return points;
}

}  // namespace automorph
