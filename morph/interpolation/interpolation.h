#pragma once

#include <Eigen/Core>

#include "morph/mesh/mesh.h"

namespace automorph {

/// [Urtasun04] Sec. 5: Eq. (12), (13), (14).
enum class Interpolation { Linear, RigidLinear, Slerp };

/// The two ends of a morph in correspondence.
struct Endpoints {
    Points a, b;                                      ///< #V x 3 each, in their files' units
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< rotation source -> target, det = +1
    Eigen::Vector3d centre_a = Eigen::Vector3d::Zero(), centre_b = Eigen::Vector3d::Zero();  ///< of mass
    Points shading_a, shading_b;  ///< #V x 3 each, or empty: what smooth shading lacks there, see shading.h
};

/// V(alpha), #V x 3; bit for bit `a` at alpha = 0 and `b` at alpha = 1, for every scheme. In between, with
/// the centre c = (1 - alpha) c_a + alpha c_b on a straight line:
///
/// Linear       V = (1 - alpha) a + alpha b, Eq. (12).
/// RigidLinear  V = c + M [(1 - alpha)(a - c_a) + alpha R^T (b - c_b)], M = (1 - alpha) I + alpha R: the
/// motion of
///              Eq. (13) [Alexa00] with the rotation interpolated linearly, as a matrix. M is no rotation in
///              between: across its axis it shrinks by |(1 - alpha) + alpha e^(i theta)|, by cos(theta / 2)
///              half way.
/// Slerp        the same with M = slerp(R, alpha), Eq. (14)-(15).
///
/// Deviation    Eq. (13)-(14) as printed start from the registered source R a + t, and Eq. (15) counts 1 -
/// alpha
///              from the other end; here both ends are the input shapes, and the turn is about the centre of
///              mass.
/// @pre a and b have the same size, R is a rotation, 0 <= alpha <= 1
Points interpolate(const Endpoints& ends, double alpha, Interpolation scheme);

/// What smooth shading lacks in between: (1 - alpha) M shading_a + alpha M R^T shading_b, as the vertices
/// move; #V x 3, or empty if the ends have none.
Points interpolate_shading(const Endpoints& ends, double alpha, Interpolation scheme);

/// Slerp(1, R, alpha) of unit quaternions, as a matrix: the turn about R's axis by alpha times its angle,
/// which is in [0, pi]. At exactly pi both ways round are equally short; the one taken depends on R only.
/// @pre R is a rotation
Eigen::Matrix3d slerp(const Eigen::Matrix3d& R, double alpha);

}  // namespace automorph
