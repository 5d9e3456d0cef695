#include "morph/alignment/closest_point.h"

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "morph/alignment/facet_tree.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity(),
                 kAnyDistance = std::numeric_limits<double>::max();

/// Rounding of coordinates, normals and distances, in sizes of the mesh.
constexpr double kSlack = 1e-12;

/// What lies no farther than this is looked through, so that rounding hides nothing as close as the closest.
double widened(double squared_distance) {
    const double distance = std::sqrt(squared_distance) * (1.0 + kSlack) + kSlack;
    return distance * distance;
}

Points facet_normals(const Mesh& mesh) {
    Points normals(mesh.F.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.F.rows(); ++f)
        normals.row(f) = doubled_area_vector(mesh.V, mesh.F, f).stableNormalized();
    return normals;
}

/// Barycentric coordinates of the point of triangle abc closest to p [Ericson05, Sec. 5.1.5].
Eigen::Vector3d closest(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c) {
    const Eigen::Vector3d ab = b - a, ac = c - a, ap = p - a;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
    const Eigen::Vector3d bp = p - b;
    const double d3 = ab.dot(bp), d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double v = d1 / (d1 - d3);
        return {1.0 - v, v, 0.0};
    }
    const Eigen::Vector3d cp = p - c;
    const double d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double w = d2 / (d2 - d6);
        return {1.0 - w, 0.0, w};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0.0, 1.0 - w, w};
    }
    const double sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

}  // namespace

struct ClosestPoints::Tree {
    UnitFrame frame;
    Mesh mesh;  // in that frame
    Points normals;
    FacetTree facets;

    explicit Tree(const Mesh& of)
        : frame(of.V), mesh{frame.in(of.V), of.F}, normals(facet_normals(mesh)), facets(mesh, normals) {}

    Eigen::Vector3d in_frame(const Eigen::Vector3d& point) const {
        return (point - frame.centre.transpose()) / frame.size;
    }
    SurfacePlace place(int triangle, const Eigen::Vector3d& weights) const {
        return {{mesh.F(triangle, 0), mesh.F(triangle, 1), mesh.F(triangle, 2)}, weights};
    }
};

ClosestPoints::ClosestPoints(const Mesh& mesh) : tree_(std::make_unique<Tree>(mesh)) {}
ClosestPoints::~ClosestPoints() = default;

SurfacePlace ClosestPoints::query(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                  double least_agreement) const {
    const Eigen::Vector3d p = tree_->in_frame(point);
    const auto lowest = [&](const FacetTree::Bounds& bounds) {
        const double best_agreement = normal.cwiseProduct(bounds.normals.min())
                                          .cwiseMax(normal.cwiseProduct(bounds.normals.max()))
                                          .sum();
        return best_agreement + kSlack > least_agreement ? bounds.places.squaredExteriorDistance(p)
                                                         : kNowhere;
    };
    double least = kNowhere, limit = kAnyDistance;
    int triangle = -1;
    Eigen::Vector3d weights;
    tree_->facets.search(lowest, limit, [&](int f) {
        if (!(normal.dot(tree_->normals.row(f)) > least_agreement)) return;
        const Eigen::Vector3d a = tree_->mesh.V.row(tree_->mesh.F(f, 0)),
                              b = tree_->mesh.V.row(tree_->mesh.F(f, 1)),
                              c = tree_->mesh.V.row(tree_->mesh.F(f, 2));
        const Eigen::Vector3d w = closest(p, a, b, c);
        if (!w.allFinite()) return;
        const double distance2 = (w[0] * a + w[1] * b + w[2] * c - p).squaredNorm();
        if (distance2 > least || (distance2 == least && f > triangle)) return;
        least = distance2;
        limit = widened(least);
        triangle = f;
        weights = w;
    });
    return triangle < 0 ? SurfacePlace{} : tree_->place(triangle, weights);
}

SurfacePlace ClosestPoints::nearest_facet(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                                          double scale) const {
    const Eigen::Vector3d p = tree_->in_frame(point);
    const double per_area = 1.0 / (scale * scale);
    const auto lowest = [&](const FacetTree::Bounds& bounds) {
        return bounds.places.squaredExteriorDistance(p) * per_area +
               bounds.normals.squaredExteriorDistance(normal);
    };
    double least = kNowhere, limit = kAnyDistance;
    int triangle = -1;
    tree_->facets.search(lowest, limit, [&](int f) {
        const Eigen::Vector3d centroid =
            tree_->mesh.V(tree_->mesh.F.row(f), Eigen::all).colwise().sum().transpose() / 3.0;
        const double distance2 = (centroid - p).squaredNorm() * per_area +
                                 (tree_->normals.row(f).transpose() - normal).squaredNorm();
        if (distance2 > least || (distance2 == least && f > triangle)) return;
        least = distance2;
        limit = widened(least);
        triangle = f;
    });
    return triangle < 0 ? SurfacePlace{} : tree_->place(triangle, Eigen::Vector3d::Constant(1.0 / 3.0));
}

}  // namespace automorph
