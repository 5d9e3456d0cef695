#include "morph/sphere_alignment/surface_matches.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "morph/mesh/geometry.h"
#include "morph/registration/nearest.h"
#include "morph/registration/pose_distance.h"

namespace automorph {

namespace {

/// Points per surface that may be found, and every how many-th of them looks for a partner: the chance gaps
/// of the sample are noise in the matches, their number only costs time.
constexpr int kSamples = 16000, kStride = 16;
/// Longest way back, in units of the sample's spacing.
constexpr double kReturn = 2.0;
/// Distance (position and normal) at which a match has a confidence of exp(-1/2), as a multiple of the
/// median.
constexpr double kTrust = 4.0;

struct Sample {
    std::vector<SurfacePoint> points;
    NearestPoints<6>::Rows features;  ///< #points x 6: position in radii of the target, weighted normal
    double spacing = 0.0;             ///< root of the area per point
};

double uniform(std::mt19937_64& generator) {
    return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

/// One point at random in each of kSamples stretches of equal area.
Sample sample(const Surface& surface, std::uint64_t seed) {
    const Mesh& mesh = surface.mesh;
    std::mt19937_64 random(seed);
    Eigen::VectorXd areas = triangle_areas(mesh);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        if (surface.ignored[static_cast<std::size_t>(f)]) areas[f] = 0.0;
    }
    const double step = areas.sum() / kSamples;
    Sample result;
    result.features.resize(kSamples, 6);
    result.spacing = std::sqrt(step);
    int f = 0;
    double before = 0.0;  // area of the triangles before f
    for (int k = 0; k < kSamples; ++k) {
        const double place = (k + uniform(random)) * step;
        while (f + 1 < mesh.triangle_count() && before + areas[f] < place) before += areas[f++];
        const double root = std::sqrt(uniform(random)), share = uniform(random);
        const SurfacePoint point{{mesh.F(f, 0), mesh.F(f, 1), mesh.F(f, 2)},
                                 {1.0 - root, root * (1.0 - share), root * share}};
        Eigen::Vector3d position = Eigen::Vector3d::Zero();
        for (int c = 0; c < 3; ++c)
            position += point.weights[static_cast<std::size_t>(c)] * mesh.V.row(mesh.F(f, c));
        result.features.row(k) << position.transpose(),
            kNormalWeight * doubled_area_vector(mesh.V, mesh.F, f).normalized().transpose();
        result.points.push_back(point);
    }
    return result;
}

struct Nearest {
    int row;
    double distance;
};

Nearest nearest(const NearestPoints<6>& tree, const Sample& of, int row) {
    std::uint32_t found = 0;
    double squared = 0.0;
    tree.query(of.features.row(row).data(), 1, &found, &squared);
    return {static_cast<int>(found), std::sqrt(squared)};
}

/// Partners in `to` of every kStride-th point of `from`, as (from, to, distance); only those whose partner's
/// own partner is a near neighbour.
struct Match {
    int from, to;
    double distance;
};
std::vector<Match> one_way(const Sample& from, const NearestPoints<6>& tree_from, const Sample& to,
                           const NearestPoints<6>& tree_to) {
    std::vector<Match> found(kSamples / kStride);
    tbb::parallel_for(0, kSamples / kStride, [&](int k) {
        const int i = k * kStride;
        const Nearest there = nearest(tree_to, from, i);
        const Nearest back = nearest(tree_from, to, there.row);
        const bool returns = (from.features.row(i) - from.features.row(back.row)).norm() <=
                             std::max(kReturn * from.spacing, there.distance);
        found[static_cast<std::size_t>(k)] = {returns ? i : -1, there.row, there.distance};
    });
    std::erase_if(found, [](const Match& match) { return match.from < 0; });
    return found;
}

}  // namespace

SurfaceMatches match_surfaces(const Surface& a, const Surface& b, const Registration& registration,
                              std::uint64_t seed) {
    const Mesh moved{registration.apply(a.mesh.V), a.mesh.F};
    Sample of_a = sample({moved, a.ignored}, seed), of_b = sample(b, seed + 1);
    const double radius = of_b.spacing * std::sqrt(kSamples / (4.0 * std::numbers::pi));
    for (Sample* each : {&of_a, &of_b}) {
        each->features.leftCols<3>() /= radius;
        each->spacing /= radius;
    }
    const NearestPoints<6> tree_a(of_a.features), tree_b(of_b.features);
    SurfaceMatches matches;
    std::vector<double> distances;
    const auto take = [&](int i, int j, double distance) {
        matches.on_a.push_back(of_a.points[static_cast<std::size_t>(i)]);
        matches.on_b.push_back(of_b.points[static_cast<std::size_t>(j)]);
        distances.push_back(distance);
    };
    for (const Match& match : one_way(of_a, tree_a, of_b, tree_b)) take(match.from, match.to, match.distance);
    for (const Match& match : one_way(of_b, tree_b, of_a, tree_a)) take(match.to, match.from, match.distance);
    if (distances.empty()) return matches;
    std::vector<double> sorted = distances;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    const double trusted = kTrust * std::max(sorted[sorted.size() / 2], of_b.spacing);
    matches.weights.resize(static_cast<Eigen::Index>(distances.size()));
    for (std::size_t k = 0; k < distances.size(); ++k) {
        const double x = distances[k] / trusted;
        matches.weights[static_cast<Eigen::Index>(k)] = std::exp(-0.5 * x * x);
    }
    return matches;
}

Points rays_of(const Points& rays, const std::vector<SurfacePoint>& points) {
    Points result(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t k = 0; k < points.size(); ++k) {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (std::size_t c = 0; c < 3; ++c) sum += points[k].weights[c] * rays.row(points[k].corners[c]);
        result.row(static_cast<Eigen::Index>(k)) = sum.normalized();
    }
    return result;
}

}  // namespace automorph
