#include "morph/registration/procrustes.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cassert>
#include <cmath>

namespace automorph {

Eigen::Matrix3d best_rotation(const Eigen::Matrix3d& cross_covariance) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(cross_covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Eigen::Matrix3d &U = svd.matrixU(), &V = svd.matrixV();
    // The singular values are sorted: a reflection is undone along the direction that matters least.
    const double sign = (V * U.transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    return V * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * U.transpose();
}

RigidMotion weighted_procrustes(const Points& source, const Points& target, const Eigen::VectorXd& weights) {
    assert(source.rows() == target.rows() && source.rows() == weights.size());
    const double total = weights.sum();
    assert(total > 0.0);
    const Eigen::RowVector3d source_mean = weights.transpose() * source / total;
    const Eigen::RowVector3d target_mean = weights.transpose() * target / total;
    const Points x = source.rowwise() - source_mean, y = target.rowwise() - target_mean;

    RigidMotion motion;
    motion.R = best_rotation(x.transpose() * weights.asDiagonal() * y);
    motion.t = target_mean.transpose() - motion.R * source_mean.transpose();
    return motion;
}

double rotation_angle(const Eigen::Matrix3d& R) {
    const Eigen::Vector3d axis(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
    return std::atan2(axis.norm(), R.trace() - 1.0);
}

}  // namespace automorph
