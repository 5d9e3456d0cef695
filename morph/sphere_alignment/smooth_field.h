#pragma once

#include <array>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A smooth vector field on the unit sphere: the Gaussian-weighted mean of vectors given at scattered places.
/// Far from all places it tends to zero.
///
/// Method  the mean is taken at the nodes of a grid on the six faces of a cube and interpolated bilinearly
/// between
///         them: the cost of a query does not depend on the number of places.
class SmoothField {
public:
    /// @param places   #n x 3, unit vectors
    /// @param vectors  #n x 3
    /// @param weights  #n, >= 0
    /// @param width    of the Gaussian, radians
    SmoothField(const Points& places, const Points& vectors, const Eigen::VectorXd& weights, double width);

    Eigen::Vector3d operator()(const Eigen::Vector3d& unit) const;

private:
    int cells_ = 1;  ///< along the edge of a cube face
    std::vector<Eigen::Vector3d> nodes_;
};

}  // namespace automorph
