#pragma once

#include <Eigen/Core>

#include "morph/mesh/mesh.h"

namespace automorph {

/// [Urtasun04] Sec. 5: Eq. (12), (13), (14).
enum class Interpolation { Linear, RigidLinear, Slerp };

/// The two ends of a morph in correspondence.
struct Endpoints {
    Points a, b;                             ///< #V x 3 each
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< rotation source -> target
    Eigen::Vector3d centre_a = Eigen::Vector3d::Zero(), centre_b = Eigen::Vector3d::Zero();  ///< of mass
};

/// V(alpha), #V x 3; exactly `a` at alpha = 0 and exactly `b` at alpha = 1, for every scheme.
/// Slerp: V = c(alpha) + R(alpha) [(1 - alpha)(a - c_a) + alpha R^T (b - c_b)], R(alpha) = Slerp(1, R, alpha).
/// Deviation from the paper's text: its 1 - alpha counts from the other end.
/// @pre 0 <= alpha <= 1
Points interpolate(const Endpoints& ends, double alpha, Interpolation scheme);

}  // namespace automorph
