#include "morph/parameterization/map_quality.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "morph/exact/predicates.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

/// Share of the surface below p01.
constexpr double kPercentile = 0.01;

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

/// Quality from the triangles' areas on the domain (#F), which sum to `domain`.
MapQuality quality_of(const Mesh& mesh, const Points& rays, const std::vector<double>& on_domain) {
    MapQuality quality;
    quality.flipped = flipped_triangles(mesh.F, rays);
    const Eigen::VectorXd areas = triangle_areas(mesh);
    const double surface = areas.sum();
    const double domain = std::accumulate(on_domain.begin(), on_domain.end(), 0.0);
    if (!(surface > 0.0) || !(domain > 0.0)) return quality;

    std::vector<std::pair<double, double>> ratios;  // (ratio, share of the surface)
    ratios.reserve(on_domain.size());
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const double share = areas[f] / surface;
        if (share > 0.0) ratios.emplace_back(on_domain[static_cast<std::size_t>(f)] / domain / share, share);
    }
    std::sort(ratios.begin(), ratios.end());
    quality.smallest_ratio = ratios.front().first;
    double below = 0.0;
    for (const auto& [ratio, share] : ratios) {
        quality.p01 = ratio;
        below += share;
        if (below >= kPercentile) break;
    }
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

MapQuality map_quality(const Mesh& mesh, const Points& rays) {
    std::vector<double> areas;
    areas.reserve(static_cast<std::size_t>(mesh.triangle_count()));
    for (int f = 0; f < mesh.triangle_count(); ++f) areas.push_back(doubled_area(mesh.F, rays, f));
    return quality_of(mesh, rays, areas);
}

MapQuality sphere_map_quality(const Mesh& mesh, const Points& rays) {
    std::vector<double> areas;
    areas.reserve(static_cast<std::size_t>(mesh.triangle_count()));
    for (int f = 0; f < mesh.triangle_count(); ++f) areas.push_back(solid_angle(mesh.F, rays, f));
    return quality_of(mesh, rays, areas);
}

double total_solid_angle(const Triangles& F, const Points& rays) {
    double sum = 0.0;
    for (int f = 0; f < F.rows(); ++f) sum += solid_angle(F, rays, f);
    return sum;
}

}  // namespace automorph
