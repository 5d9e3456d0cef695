#include "morph/interpolation/interpolation.h"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

// Notation: a, b the ends, c_a, c_b their centres, R the rotation a -> b, M its part at alpha.

namespace automorph {

namespace {

Points blend(const Endpoints& ends, double alpha) {
    return (1.0 - alpha) * ends.a + alpha * ends.b;
}

/// c + M [(1 - alpha)(a - c_a) + alpha R^T (b - c_b)], with the two products taken together once.
Points move(const Endpoints& ends, double alpha, const Eigen::Matrix3d& M) {
    const Eigen::Matrix3d from_a = (1.0 - alpha) * M, from_b = alpha * (M * ends.R.transpose());
    const Eigen::Vector3d c = (1.0 - alpha) * ends.centre_a + alpha * ends.centre_b;
    Points V(ends.a.rows(), 3);
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        const Eigen::Vector3d a = ends.a.row(i).transpose() - ends.centre_a;
        const Eigen::Vector3d b = ends.b.row(i).transpose() - ends.centre_b;
        V.row(i) = (c + (from_a * a + from_b * b)).transpose();
    }
    return V;
}

}  // namespace

Eigen::Matrix3d slerp(const Eigen::Matrix3d& R, double alpha) {
    // Eigen divides by the largest of the four components, so no angle is special. The arc tangent keeps its
    // digits at 0 and at pi, where the arc cosine of the quaternion's real part would lose half of them.
    Eigen::Quaterniond q(R);
    q.normalize();
    if (q.w() < 0.0) q.coeffs() = -q.coeffs();  // q and -q are one rotation: take the shorter way round
    const double sine = q.vec().norm();         // of half the angle
    if (sine == 0.0) return Eigen::Matrix3d::Identity();
    const double half = std::atan2(sine, q.w());
    Eigen::Quaterniond part;
    part.w() = std::cos(alpha * half);
    part.vec() = (std::sin(alpha * half) / sine) * q.vec();
    return part.toRotationMatrix();
}

Points interpolate_shading(const Endpoints& ends, double alpha, Interpolation scheme) {
    Endpoints shading;
    shading.a = ends.shading_a;
    shading.b = ends.shading_b;
    shading.R = ends.R;
    return interpolate(shading, alpha, scheme);
}

Points interpolate(const Endpoints& ends, double alpha, Interpolation scheme) {
    assert(ends.a.rows() == ends.b.rows());
    assert(0.0 <= alpha && alpha <= 1.0);
    if (alpha == 0.0) return ends.a;
    if (alpha == 1.0) return ends.b;
    switch (scheme) {
        case Interpolation::Linear:
            return blend(ends, alpha);
        case Interpolation::RigidLinear:
            return move(ends, alpha, (1.0 - alpha) * Eigen::Matrix3d::Identity() + alpha * ends.R);
        case Interpolation::Slerp:
            return move(ends, alpha, slerp(ends.R, alpha));
    }
    assert(false);
    return ends.a;
}

}  // namespace automorph
