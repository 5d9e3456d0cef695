#include "morph/registration/rigid_step.h"

#include <Eigen/Geometry>

namespace automorph {

RigidStep step_between(const RigidMotion& from, const RigidMotion& to) {
    const Eigen::Matrix3d R = to.R * from.R.transpose();
    RigidStep step;
    step << Eigen::Vector3d(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1)) / (1.0 + R.trace()),
        to.t - from.t;
    return step;
}

double step_length(const RigidStep& step) {
    return 2.0 * step.head<3>().norm() + step.tail<3>().norm();
}

Eigen::Matrix3d rodrigues_rotation(const Eigen::Vector3d& rodrigues) {
    return Eigen::Quaterniond(1.0, rodrigues.x(), rodrigues.y(), rodrigues.z())
        .normalized()
        .toRotationMatrix();
}

}  // namespace automorph
