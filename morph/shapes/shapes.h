#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "morph/mesh/mesh.h"

namespace automorph {

/// How a generated shape is triangulated and posed; every seed gives another tessellation of the same
/// surface.
struct ShapeOptions {
    int triangles = 8000;    ///< made even, at least 4
    std::uint64_t seed = 1;  ///< of the tessellation
    /// Pose: a vertex p of the surface goes to scale * rotation * p + translation.
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();
    double scale = 1.0;
};

/// Ellipsoid about the origin with the given semi-axes along x, y, z. Vertices lie on it to rounding;
/// the triangles are even (see remesh.h) and face outwards. The same options give the same bits.
/// @param opening  this share of its height along z is cut off below by a plane: 0 leaves it closed
/// @throws InvalidMesh unless all semi-axes are positive and finite and 0 <= opening <= 0.9
Mesh ellipsoid(const Eigen::Vector3d& semi_axes, const ShapeOptions& options = {}, double opening = 0.0);

/// Closed, smooth, solid star: `arms` rounded arms in the xy-plane, the first along x; in that plane tips at
/// radius `outer`, valleys at `inner`, half-thickness `depth` in z at the centre.
struct StarParameters {
    int arms = 5;
    double outer = 1.0, inner = 0.45, depth = 0.3;
};

/// The surface is infinitely smooth: see star.cpp for its equation. Meshed like the ellipsoid.
/// @throws InvalidMesh unless 3 <= arms <= 12, 0.2 <= inner / outer <= 0.8 and 0.05 <= depth / outer <= 1
Mesh star(const StarParameters& parameters, const ShapeOptions& options = {});

}  // namespace automorph
