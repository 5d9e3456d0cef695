#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "morph/registration/em_icp.h"
#include "morph/registration/neighbourhoods.h"
#include "morph/registration/rigid_step.h"

namespace automorph {

namespace {

// Weight of a distance across the normal, beside 1 along it: enough to hold what planes alone leave free (a
// flat sheet slides, a sphere turns), too little for the samples' chance gaps to matter.
constexpr double kAcross = 0.01;

// On shapes that differ, other neighbours come in with every step, and the pose swings about its place
// without end: steps that are small, but get no smaller. It has settled then.
constexpr int kPatience = 10;      // steps since the smallest one
constexpr double kSettled = 1e-3;  // that smallest one at most; turn (radians) + shift, as the tolerance

// The Gauss-Newton step of sum_i (n_i d_i)^2 + kAcross |d_i|^2, with d_i = y_i - (p_i + w x p_i + s).
RigidStep gauss_newton_step(const Points& moved, const Points& expected, const Points& normals) {
    using Matrix6 = Eigen::Matrix<double, 6, 6>;
    Matrix6 H = Matrix6::Zero();
    RigidStep g = RigidStep::Zero();
    for (Eigen::Index i = 0; i < moved.rows(); ++i) {
        const Eigen::Vector3d p = moved.row(i), n = normals.row(i), d = expected.row(i).transpose() - p;
        RigidStep along;
        along << p.cross(n), n;
        Eigen::Matrix<double, 3, 6> across;
        across << 0, p.z(), -p.y(), 1, 0, 0, -p.z(), 0, p.x(), 0, 1, 0, p.y(), -p.x(), 0, 0, 0, 1;
        H += along * along.transpose() + kAcross * across.transpose() * across;
        g += along * n.dot(d) + kAcross * across.transpose() * d;
    }
    RigidStep step = H.ldlt().solve(g);
    step.head<3>() *= 0.5;  // angle to Rodrigues vector
    return step;
}

}  // namespace

EmIcpResult polish_along_normals(const Points& source, const NearestPoints<3>& target,
                                 const Points& target_normals, const RigidMotion& start,
                                 const EmIcpOptions& options) {
    Neighbourhoods near(target, source.rows(), options.neighbours);
    EmIcpResult result;
    result.motion = start;
    double smallest = std::numeric_limits<double>::infinity();
    int since = 0;
    while (true) {
        const Points moved = result.motion.apply(source);
        near.find(moved);
        result.sigma = near.sigma();
        if (result.converged || result.iterations >= options.max_iterations) return result;

        // Where front and back are mixed the mean normal is short, and such a point counts little.
        const RigidStep step = gauss_newton_step(moved, near.expected(target.points(), result.sigma),
                                                 near.expected(target_normals, result.sigma));
        if (!step.allFinite()) return result;  // all points at one place
        const Eigen::Matrix3d turn = rodrigues_rotation(step.head<3>());
        result.motion.R = turn * result.motion.R;
        result.motion.t = turn * result.motion.t + step.tail<3>();
        ++result.iterations;
        const double length = step_length(step);
        since = length < smallest ? 0 : since + 1;
        smallest = std::min(smallest, length);
        result.converged = length < options.motion_tolerance || (since >= kPatience && smallest < kSettled);
    }
}

}  // namespace automorph
