#pragma once

#include <Eigen/Core>

#include "morph/registration/nearest.h"
#include "morph/registration/procrustes.h"
#include "morph/registration/surface_sample.h"

namespace automorph {

/// Weight of normals in a distance, in units of the shape's radius: opposite normals count like a gap of twice
/// this. Front and back of a flat shape differ by it; a smooth shape's neighbours hardly do.
inline constexpr double kNormalWeight = 0.25;

/// Mean of the smaller 80 % of the values: what one shape lacks (another crop, hair, a hat) does not count.
double trimmed_mean(Eigen::ArrayXd values);

/// How badly two size-normalised shapes agree in a pose: for points of either shape the distance
/// sqrt(|x - y|^2 + kNormalWeight^2 |n_x - n_y|^2) to the nearest point of the other, trimmed mean of each
/// direction, mean of both. In units of the target's radius.
class PoseDistance {
public:
    /// @param source, target  dense samples
    PoseDistance(const SurfaceSample& source, const SurfaceSample& target);

    /// @param probes  how many points of either shape look for the other
    /// @param normal_sign  -1 compares with the target's normals reversed
    double operator()(const RigidMotion& motion, int probes, double normal_sign = 1.0) const;

private:
    const SurfaceSample& source_;
    const SurfaceSample& target_;
    NearestPoints<6> source_tree_, target_tree_;
};

}  // namespace automorph
