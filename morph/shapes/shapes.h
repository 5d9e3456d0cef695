#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "morph/mesh/mesh.h"

namespace automorph {

/// How a generated shape is triangulated and posed; every seed gives another tessellation of the same surface.
struct ShapeOptions {
    int triangles = 8000;                    ///< about this many
    std::uint64_t seed = 1;                  ///< of the tessellation
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    double scale = 1.0;
};

/// Closed ellipsoid with the given semi-axes.
Mesh ellipsoid(const Eigen::Vector3d& semi_axes, const ShapeOptions& options = {});

/// Closed, smooth, solid star: `arms` rounded arms in the xy-plane, tips at `outer`, valleys at `inner`,
/// half-thickness `depth` in z at the centre.
struct StarParameters {
    int arms = 5;
    double outer = 1.0, inner = 0.45, depth = 0.3;
};
Mesh star(const StarParameters& parameters, const ShapeOptions& options = {});

}  // namespace automorph
