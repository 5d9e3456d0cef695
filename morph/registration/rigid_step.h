#pragma once

#include <Eigen/Core>

#include "morph/registration/procrustes.h"

namespace automorph {

/// A small change of a rigid motion: the Rodrigues vector tan(angle / 2) * axis of a turn about the origin
/// (of the target's frame), then a shift. Needs no trigonometry; not for half-turns.
using RigidStep = Eigen::Matrix<double, 6, 1>;

/// The step that leads from one motion to another: to.R = turn * from.R, to.t = from.t + shift.
RigidStep step_between(const RigidMotion& from, const RigidMotion& to);

/// Turn in radians (for small ones) + shift in target units.
double step_length(const RigidStep& step);

/// The rotation of a Rodrigues vector.
Eigen::Matrix3d rodrigues_rotation(const Eigen::Vector3d& rodrigues);

}  // namespace automorph
