#include "morph/registration/em_icp.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace automorph {

namespace {

constexpr int kGrain = 64;  // points per task: some 0.1 ms of tree queries

// The truncated neighbourhoods of all source points at one pose: rows of k.
struct Neighbourhoods {
    int k;
    std::vector<std::uint32_t> target;
    std::vector<double> squared_distance;

    Neighbourhoods(Eigen::Index n, int neighbours) : k(neighbours), target(n * k), squared_distance(n * k) {}
};

void find_neighbours(const Points& moved, const NearestPoints<3>& tree, Neighbourhoods& near) {
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, moved.rows(), kGrain), [&](const auto& range) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
            tree.query(moved.row(i).data(), near.k, &near.target[i * near.k], &near.squared_distance[i * near.k]);
        }
    });
}

// Eq. (7).
double mean_nearest_distance(const Neighbourhoods& near, Eigen::Index n) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) sum += std::sqrt(near.squared_distance[i * near.k]);
    return sum / static_cast<double>(n);
}

// Where each source point is drawn to: sum_j p_ij x'_j.
Points expected_targets(const Neighbourhoods& near, const Points& target, Eigen::Index n, double sigma) {
    Points expected = Points::Zero(n, 3);
    std::vector<double> p(near.k);
    for (Eigen::Index i = 0; i < n; ++i) {
        responsibility_row(&near.squared_distance[i * near.k], near.k, sigma, p.data());
        for (int j = 0; j < near.k; ++j) expected.row(i) += p[j] * target.row(near.target[i * near.k + j]);
    }
    return expected;
}

}  // namespace

void responsibility_row(const double* squared_distances, int k, double sigma, double* p) {
    const double scale = 2.0 * sigma * sigma;
    double sum = 0.0;
    for (int j = 0; j < k; ++j) {
        const double farther = squared_distances[j] - squared_distances[0];
        // Equal distances share also where sigma is 0 or so small that the quotient overflows.
        p[j] = farther > 0.0 ? (scale > 0.0 ? std::exp(-farther / scale) : 0.0) : 1.0;
        sum += p[j];
    }
    for (int j = 0; j < k; ++j) p[j] /= sum;
}

EmIcpResult em_icp(const Points& source, const NearestPoints<3>& target, const RigidMotion& start,
                   const EmIcpOptions& options) {
    assert(source.rows() > 0 && target.size() > 0);
    const Eigen::Index n = source.rows();
    const Eigen::VectorXd weights = Eigen::VectorXd::Ones(n);
    Neighbourhoods near(n, std::clamp(options.neighbours, 1, target.size()));

    EmIcpResult best;
    best.motion = start;
    best.sigma = std::numeric_limits<double>::infinity();
    RigidMotion motion = start;
    while (true) {
        find_neighbours(motion.apply(source), target, near);
        const double sigma = mean_nearest_distance(near, n);
        if (sigma < best.sigma) {
            best.motion = motion;
            best.sigma = sigma;
        }
        if (best.converged || best.iterations >= options.max_iterations) return best;

        const RigidMotion next =
            weighted_procrustes(source, expected_targets(near, target.points(), n, sigma), weights);
        ++best.iterations;
        const double change =
            rotation_angle(next.R * motion.R.transpose()) + (next.t - motion.t).norm();
        best.converged = change < options.motion_tolerance;
        motion = next;
    }
}

}  // namespace automorph
