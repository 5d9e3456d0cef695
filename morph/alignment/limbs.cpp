#include "morph/alignment/limbs.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "morph/alignment/geodesic.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/index.h"

namespace automorph {

namespace {

using Eigen::RowVector3d;
using Eigen::Vector3d;

// Lengths here are in roots of the surface's area, in which a ball has a radius of 0.28.
constexpr int kSources = 40;         // points whose distances are averaged
constexpr double kApart = 0.15;      // between tips
constexpr double kNearBorder = 0.1;  // nearer to a border there is no tip
constexpr double kAround = 0.25;     // where the surface about a tip is measured,
constexpr double kSlender = 0.5;     // which may be so much of a flat disk there: a ball has 0.82
constexpr double kStep = 0.04;       // between rings
constexpr double kWidens = 2.0;      // times the median girth so far: here the limb ends
constexpr int kShortest = 3;         // rings
constexpr double kFarthest = 0.4;  // between matched tips in place, in box diagonals, and with that in reach,
constexpr double kReachWeight = 0.15;  // in sizes
constexpr double kAgree = 1.6;         // factor between two distances that are taken for the same

/// Vertices that stand for equal shares of the surface.
std::vector<int> even_vertices(const Eigen::VectorXd& areas) {
    std::vector<int> chosen;
    const double step = areas.sum() / kSources;
    double passed = 0.0;
    for (int v = 0; v < areas.size(); ++v) {
        passed += areas[v];
        if (passed > (static_cast<double>(chosen.size()) + 0.5) * step) chosen.push_back(v);
        while (passed > (static_cast<double>(chosen.size()) + 0.5) * step) chosen.push_back(v);
    }
    return chosen;
}

Eigen::VectorXd mean_distances(const SurfaceDistances& surface, const Eigen::VectorXd& areas) {
    const std::vector<int> sources = even_vertices(areas);
    std::vector<Eigen::VectorXd> each(sources.size());
    tbb::parallel_for(std::size_t{0}, sources.size(),
                      [&](std::size_t k) { each[k] = surface.from({sources[k]}); });
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(areas.size());
    for (const Eigen::VectorXd& distances : each) sum += distances;
    return sum / static_cast<double>(sources.size());
}

/// Vertices that lie farther out than their neighbours, the farthest first.
std::vector<int> maxima(const Triangles& F, const Eigen::VectorXd& value) {
    std::vector<char> lower(static_cast<std::size_t>(value.size()), 0), used(lower);
    const auto above = [&](int v, int w) { return value[v] > value[w] || (value[v] == value[w] && v < w); };
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int v = F(f, k), w = F(f, (k + 1) % 3);
            used[at(v)] = 1;
            lower[at(above(v, w) ? w : v)] = 1;
        }
    }
    std::vector<int> found;
    for (int v = 0; v < value.size(); ++v) {
        if (used[at(v)] && !lower[at(v)] && std::isfinite(value[v])) found.push_back(v);
    }
    std::sort(found.begin(), found.end(), above);
    return found;
}

/// Area and middle of the surface between rings about a tip.
struct Rings {
    std::vector<double> area;
    std::vector<RowVector3d> middle;
};

Rings rings_about(const Points& V, const Eigen::VectorXd& areas, const Eigen::VectorXd& distance,
                  double step) {
    const auto count = at(static_cast<int>(distance.maxCoeff() / step)) + 1;
    Rings rings{std::vector<double>(count, 0.0), std::vector<RowVector3d>(count, RowVector3d::Zero())};
    for (Eigen::Index v = 0; v < V.rows(); ++v) {
        const auto ring = static_cast<std::size_t>(distance[v] / step);
        rings.area[ring] += areas[v];
        rings.middle[ring] += areas[v] * V.row(v);
    }
    for (std::size_t k = 0; k < count; ++k) {
        if (rings.area[k] > 0.0) rings.middle[k] /= rings.area[k];
    }
    return rings;
}

/// How many rings the limb has: it ends where it widens, at the latest half way to the other end.
int limb_rings(const std::vector<double>& area) {
    std::vector<double> before;
    const int most = static_cast<int>(area.size()) / 2;
    for (int k = 1; k < most; ++k) {
        if (area[at(k)] <= 0.0) return k;
        if (static_cast<int>(before.size()) >= kShortest) {
            std::vector<double> sorted = before;
            const auto median = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
            std::nth_element(sorted.begin(), median, sorted.end());
            if (area[at(k)] > kWidens * *median) return k;
        }
        before.push_back(area[at(k)]);
    }
    return most;
}

/// The axis from ring middles: those lie half a step beyond their ring's beginning.
Points axis_of(const RowVector3d& tip, const Rings& rings, int count) {
    Points axis(count + 1, 3);
    axis.row(0) = tip;
    for (int k = 1; k <= count; ++k) {
        const RowVector3d& here = rings.middle[at(k - 1)];
        const bool more = at(k) < rings.area.size() && rings.area[at(k)] > 0.0;
        axis.row(k) = more ? RowVector3d(0.5 * (here + rings.middle[at(k)])) : here;
    }
    return axis;
}

/// Distances between tips, in sizes of their surfaces: may both pairs be right?
bool agree(double source_distance, double target_distance) {
    const double ratio = source_distance / target_distance;
    return ratio < kAgree && ratio > 1.0 / kAgree;
}

}  // namespace

RowVector3d Limb::middle(double distance) const {
    const double place = std::clamp(distance / step, 0.0, static_cast<double>(axis.rows() - 1));
    const auto k = std::min(static_cast<Eigen::Index>(place), axis.rows() - 2);
    const double share = place - static_cast<double>(k);
    return (1.0 - share) * axis.row(k) + share * axis.row(k + 1);
}

RowVector3d Limb::direction(double distance) const {
    constexpr double kSpan = 2.0;  // steps
    const double end = static_cast<double>(axis.rows() - 1) * step;
    const double middle_of_span = std::clamp(distance, 0.5 * kSpan * step, end - 0.5 * kSpan * step);
    return (middle(middle_of_span + 0.5 * kSpan * step) - middle(middle_of_span - 0.5 * kSpan * step))
        .stableNormalized();
}

Limbs find_limbs(const Mesh& mesh, const std::vector<std::vector<int>>& loops) {
    const Eigen::VectorXd areas = vertex_areas(mesh);
    const double unit = std::sqrt(areas.sum());
    Limbs found;
    std::vector<Limb>& limbs = found.limbs;
    if (!(unit > 0.0) || !std::isfinite(unit)) return found;
    const SurfaceDistances surface(mesh);
    const Eigen::VectorXd mean = mean_distances(surface, areas);
    std::vector<int> border;
    for (const std::vector<int>& loop : loops) border.insert(border.end(), loop.begin(), loop.end());
    const Eigen::VectorXd inside = surface.from(border);
    for (const int tip : maxima(mesh.F, mean)) {
        if (inside[tip] < kNearBorder * unit || mean[tip] <= mean.minCoeff()) continue;
        if (std::any_of(limbs.begin(), limbs.end(),
                        [&](const Limb& limb) { return limb.from_tip[tip] < kApart * unit; }))
            continue;
        Limb limb{tip, 0.0, mean[tip] - mean.minCoeff(), surface.from({tip}), {}, kStep * unit};
        if (!limb.from_tip.allFinite()) continue;
        const double around = kAround * unit;
        const double area = (limb.from_tip.array() < around).select(areas, 0.0).sum();
        if (area > kSlender * std::numbers::pi * around * around) continue;
        const Rings rings = rings_about(mesh.V, areas, limb.from_tip, limb.step);
        const int count = limb_rings(rings.area);
        if (count < kShortest) continue;
        limb.length = count * limb.step;
        limb.axis = axis_of(mesh.V.row(tip), rings, count);
        limbs.push_back(std::move(limb));
    }
    found.size = mean.dot(areas) / areas.sum();
    return found;
}

std::vector<LimbMatch> match_limbs(const Points& source, const Limbs& source_limbs, const Points& target,
                                   const Limbs& target_limbs, double diagonal) {
    const std::vector<Limb>&of_source = source_limbs.limbs, &of_target = target_limbs.limbs;
    const int n = static_cast<int>(of_source.size()), m = static_cast<int>(of_target.size());
    std::vector<LimbMatch> matches;
    if (n == 0 || m == 0) return matches;
    Eigen::MatrixXd cost(n, m);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const double apart = (source.row(of_source[at(i)].tip) - target.row(of_target[at(j)].tip)).norm(),
                         reach = of_source[at(i)].reach / source_limbs.size -
                                 of_target[at(j)].reach / target_limbs.size;
            cost(i, j) = apart / diagonal + kReachWeight * std::abs(reach);
        }
    }
    // From each promising pair on, all that contradict none of those taken, the nearest first; the set of
    // most worth wins.
    std::vector<LimbMatch> order;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            if (cost(i, j) < kFarthest) order.push_back({i, j});
        }
    }
    std::stable_sort(order.begin(), order.end(), [&](const LimbMatch& p, const LimbMatch& q) {
        return cost(p.source, p.target) < cost(q.source, q.target);
    });
    const auto fit = [&](const LimbMatch& p, const LimbMatch& q) {
        return p.source != q.source && p.target != q.target &&
               agree(of_source[at(p.source)].from_tip[of_source[at(q.source)].tip] / source_limbs.size,
                     of_target[at(p.target)].from_tip[of_target[at(q.target)].tip] / target_limbs.size);
    };
    double most = 0.0;
    for (const LimbMatch& first : order) {
        std::vector<LimbMatch> chosen{first};
        double worth = kFarthest - cost(first.source, first.target);
        for (const LimbMatch& next : order) {
            if (!std::all_of(chosen.begin(), chosen.end(),
                             [&](const LimbMatch& taken) { return fit(next, taken); }))
                continue;
            chosen.push_back(next);
            worth += kFarthest - cost(next.source, next.target);
        }
        if (worth <= most) continue;
        most = worth;
        matches = std::move(chosen);
    }
    return matches;
}

std::vector<LimbPlace> limb_places(const Mesh& source, const Limb& limb, const Limb& target) {
    const double stretch = target.reach / limb.reach;
    const double length = std::min(limb.length, target.length / stretch);
    std::vector<LimbPlace> places;
    for (int v = 0; v < source.vertex_count(); ++v) {
        const double distance = limb.from_tip[v];
        if (distance >= length) continue;
        const Vector3d from = limb.direction(distance).transpose(),
                       to = target.direction(stretch * distance).transpose();
        const Vector3d beside = (source.V.row(v) - limb.middle(distance)).transpose();
        const Vector3d turned = Eigen::Quaterniond::FromTwoVectors(from, to) * beside;
        places.push_back({v, target.middle(stretch * distance) + turned.transpose(),
                          std::min(1.0, 2.0 * (1.0 - distance / length))});
    }
    return places;
}

}  // namespace automorph
