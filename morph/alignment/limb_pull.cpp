#include "morph/alignment/limb_pull.h"

#include <Eigen/Cholesky>

#include "morph/alignment/soft_matching.h"
#include "morph/mesh/index.h"

namespace automorph {

namespace {

constexpr double kThere =
    0.06;  // of the target's diagonal: what the soft matches of the coarse levels bridge

}  // namespace

LimbPulls::LimbPulls(const Mesh& source, const std::vector<std::vector<int>>& source_loops,
                     const Mesh& target, const std::vector<std::vector<int>>& target_loops, double weight)
    : weight_(weight * oriented_points(source).weight) {
    const Limbs of_source = find_limbs(source, source_loops), of_target = find_limbs(target, target_loops);
    source_limbs_ = static_cast<int>(of_source.limbs.size());
    target_limbs_ = static_cast<int>(of_target.limbs.size());
    for (const LimbMatch match : match_limbs(source.V, of_source, target.V, of_target, 1.0)) {
        const Limb &a = of_source.limbs[at(match.source)], &b = of_target.limbs[at(match.target)];
        matched_tips_.emplace_back(a.tip, b.tip);
        limbs_.push_back({a.tip, target.V.row(b.tip), limb_places(source, a, b)});
    }
}

void LimbPulls::add(const Points& x, const Points& reference, Pulls& pulls) const {
    for (const Pulled& limb : limbs_) {
        if ((x.row(limb.tip) - limb.goal).norm() < kThere) continue;
        for (const LimbPlace& place : limb.places) {
            const double weight = weight_[place.vertex] * place.weight;
            Eigen::Matrix3d& sum = pulls.trust[at(place.vertex)];
            const Eigen::Vector3d force = sum * pulls.pull.row(place.vertex).transpose() +
                                          weight * (place.place - reference.row(place.vertex)).transpose();
            sum += weight * Eigen::Matrix3d::Identity();
            pulls.pull.row(place.vertex) = sum.ldlt().solve(force).transpose();
        }
    }
}

}  // namespace automorph
