#include "morph/parameterization/map_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "morph/exact/predicates.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

/// Share of the surface below p01.
constexpr double kPercentile = 0.01;

constexpr double kMostProbes = 100.0;  // directions; only rays that are not numbers get there

constexpr double kCollapsed = std::numeric_limits<double>::infinity();

/// Twice the signed area in the plane z = 1. Differences of near points are exact, so that thin triangles are
/// measured well; signs are decided elsewhere, by the exact predicate.
double doubled_area(const Triangles& F, const Points& rays, int f) {
    const auto a = rays.row(F(f, 0)), b = rays.row(F(f, 1)), c = rays.row(F(f, 2));
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Signed solid angle of a triangle, [Oosterom83]; the determinant is formed from differences.
double solid_angle(const Triangles& F, const Points& rays, int f) {
    const Ray a = rays.row(F(f, 0)), b = rays.row(F(f, 1)), c = rays.row(F(f, 2));
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    const double volume = a.dot((b - a).cross(c - a));
    return 2.0 * std::atan2(volume, la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

using Shares = std::vector<std::pair<double, double>>;  // (value, share of the surface)

/// The smallest value that `share` of the surface does not exceed. @param values  ascending
double quantile(const Shares& values, double share) {
    double below = 0.0;
    for (const auto& [value, part] : values) {
        below += part;
        if (below >= share) return value;
    }
    return values.back().first;
}

Distortion distortion_of(Shares values) {
    std::sort(values.begin(), values.end());
    return {quantile(values, 0.5), quantile(values, 0.95), values.back().first};
}

/// Ratio of the singular values of the linear map between triangles p and q (corners are columns). Their
/// squares are the eigenvalues of G_q G_p^-1, where G holds the dot products of two edges.
double angle_distortion(const Eigen::Matrix3d& p, const Eigen::Matrix3d& q) {
    const auto gram = [](const Eigen::Matrix3d& corners) -> Eigen::Matrix2d {
        Eigen::Matrix<double, 3, 2> edges;
        edges << corners.col(1) - corners.col(0), corners.col(2) - corners.col(0);
        return edges.transpose() * edges;
    };
    const Eigen::Matrix2d from = gram(p), to = gram(q);
    const double trace = (to * from.inverse()).trace(), determinant = to.determinant() / from.determinant();
    const double larger = 0.5 * (trace + std::sqrt(std::max(0.0, trace * trace - 4.0 * determinant)));
    return std::max(1.0, larger / std::sqrt(std::max(0.0, determinant)));
}

/// @param places  #V x 3: where the vertices are on the disk or the sphere
Distortion angle_distortion_of(const Mesh& mesh, const Points& places) {
    const Eigen::VectorXd areas = triangle_areas(mesh), shares = areas / areas.sum();
    Shares values;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        Eigen::Matrix3d p, q;
        for (int k = 0; k < 3; ++k) {
            p.col(k) = mesh.V.row(mesh.F(f, k));
            q.col(k) = places.row(mesh.F(f, k));
        }
        const double value = angle_distortion(p, q);
        if (shares[f] > 0.0 && !std::isnan(value)) values.emplace_back(value, shares[f]);
    }
    return values.empty() ? Distortion{} : distortion_of(std::move(values));
}

/// Flips and areas, from the triangles' areas on the domain (#F).
MapQuality quality_of(const Mesh& mesh, const Points& rays, const std::vector<double>& on_domain) {
    MapQuality quality;
    quality.flipped = flipped_triangles(mesh.F, rays);
    const Eigen::VectorXd areas = triangle_areas(mesh);
    const double surface = areas.sum();
    const double domain = std::accumulate(on_domain.begin(), on_domain.end(), 0.0);
    if (!(surface > 0.0) || !(domain > 0.0)) return quality;

    Shares ratios, factors;
    ratios.reserve(on_domain.size());
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const double share = areas[f] / surface;
        if (!(share > 0.0)) continue;
        const double ratio = on_domain[static_cast<std::size_t>(f)] / domain / share;
        ratios.emplace_back(ratio, share);
        factors.emplace_back(ratio > 0.0 ? std::max(ratio, 1.0 / ratio) : kCollapsed, share);
    }
    std::sort(ratios.begin(), ratios.end());
    quality.smallest_ratio = ratios.front().first;
    quality.p01 = quantile(ratios, kPercentile);
    quality.area = distortion_of(std::move(factors));
    return quality;
}

}  // namespace

int flipped_triangles(const Triangles& F, const Points& rays) {
    int flipped = 0;
    for (int f = 0; f < F.rows(); ++f) {
        if (orientation(rays.row(F(f, 0)), rays.row(F(f, 1)), rays.row(F(f, 2))) <= 0) ++flipped;
    }
    return flipped;
}

int covering_degree(const Triangles& F, const Points& rays) {
    // Triangles that contain a direction; another one is tried where it lies on an edge.
    for (double turn = 1.0; turn < kMostProbes; ++turn) {
        const Ray probe(std::cos(turn), std::sin(turn), std::sin(2.5 * turn));
        int inside = 0, on_edges = 0;
        for (int f = 0; f < F.rows() && on_edges == 0; ++f) {
            int least = 1;
            for (int k = 0; k < 3 && least >= 0; ++k)
                least = std::min(least, orientation(rays.row(F(f, k)), rays.row(F(f, (k + 1) % 3)), probe));
            inside += least > 0;
            on_edges += least == 0;
        }
        if (on_edges == 0) return inside;
    }
    return 0;
}

MapQuality map_quality(const Mesh& mesh, const Points& rays) {
    std::vector<double> areas;
    areas.reserve(static_cast<std::size_t>(mesh.triangle_count()));
    for (int f = 0; f < mesh.triangle_count(); ++f) areas.push_back(doubled_area(mesh.F, rays, f));
    MapQuality quality = quality_of(mesh, rays, areas);
    quality.angle = angle_distortion_of(mesh, rays);
    return quality;
}

MapQuality sphere_map_quality(const Mesh& mesh, const Points& rays) {
    std::vector<double> areas;
    areas.reserve(static_cast<std::size_t>(mesh.triangle_count()));
    for (int f = 0; f < mesh.triangle_count(); ++f) areas.push_back(solid_angle(mesh.F, rays, f));
    MapQuality quality = quality_of(mesh, rays, areas);
    quality.angle = angle_distortion_of(mesh, rays.rowwise().normalized());
    return quality;
}

double total_solid_angle(const Triangles& F, const Points& rays) {
    double sum = 0.0;
    for (int f = 0; f < F.rows(); ++f) sum += solid_angle(F, rays, f);
    return sum;
}

}  // namespace automorph
