#include "morph/registration/em_icp.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "morph/registration/neighbourhoods.h"
#include "morph/registration/rigid_step.h"

namespace automorph {

namespace {

constexpr double kSameDirection = 0.9;           // cosine between steps that may be extrapolated
constexpr double kFarthestExtrapolation = 10.0;  // in steps

// Steps that keep their direction and shrink by a factor rho end at step * rho / (1 - rho) farther on.
double extrapolation(const RigidStep& last, const RigidStep& step) {
    const double norms = last.norm() * step.norm();
    if (!(norms > 0.0) || last.dot(step) < kSameDirection * norms) return 0.0;
    const double rho = step.norm() / last.norm();
    return rho < 1.0 ? std::min(rho / (1.0 - rho), kFarthestExtrapolation) : kFarthestExtrapolation;
}

}  // namespace

EmIcpResult em_icp(const Points& source, const NearestPoints<3>& target, const RigidMotion& start,
                   const EmIcpOptions& options) {
    assert(source.rows() > 0 && target.size() > 0);
    const Eigen::VectorXd weights = Eigen::VectorXd::Ones(source.rows());
    Neighbourhoods near(target, source.rows(), options.neighbours);

    EmIcpResult best;
    best.sigma = std::numeric_limits<double>::infinity();
    RigidMotion motion = start;
    RigidStep last = RigidStep::Zero();
    while (true) {
        near.find(motion.apply(source));
        const double sigma = near.sigma();
        if (sigma < best.sigma) {
            best.motion = motion;
            best.sigma = sigma;
        }
        if (best.converged || best.iterations >= options.max_iterations) return best;

        const RigidMotion next = weighted_procrustes(source, near.expected(target.points(), sigma), weights);
        ++best.iterations;
        const RigidStep step = step_between(motion, next);
        best.converged = step_length(step) < options.motion_tolerance;
        const double farther = best.converged ? 0.0 : extrapolation(last, step);
        motion.R = rodrigues_rotation(farther * step.head<3>()) * next.R;
        motion.t = next.t + farther * step.tail<3>();
        last = farther > 0.0 ? RigidStep::Zero() : step;  // a plain step before the next extrapolation
    }
}

}  // namespace automorph
