#pragma once

#include <Eigen/Core>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A rigid motion y = R x + t with det R = +1.
struct RigidMotion {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    Eigen::Vector3d t = Eigen::Vector3d::Zero();

    Points apply(const Points& V) const { return (V * R.transpose()).rowwise() + t.transpose(); }
};

/// The motion that minimises sum_i w_i |R x_i + t - y_i|^2 over proper rotations, by SVD with det R = +1
/// [Kabsch76, Umeyama91]. The M-step of [Urtasun04] Sec. 4.1: Eq. (5) summed over j is this problem with
/// y_i = sum_j p_ij x'_j.
/// Collinear or coincident points leave a turn free; some best proper rotation is returned.
///
/// @param source   #n x 3
/// @param target   #n x 3, row i corresponds to row i of source
/// @param weights  #n, not negative, of positive sum
RigidMotion weighted_procrustes(const Points& source, const Points& target, const Eigen::VectorXd& weights);

/// The proper rotation R nearest to a cross-covariance H = sum_i w_i (x_i - x) (y_i - y)^T, i.e. the one that
/// maximises trace(R H).
Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& cross_covariance);

/// Angle of a rotation, in radians, 0..pi; accurate for small angles too.
double rotation_angle(const Eigen::Matrix3d& R);

}  // namespace automorph
