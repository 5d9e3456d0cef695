#pragma once

#include <Eigen/Core>

#include "morph/mesh/mesh.h"
#include "morph/shapes/implicit.h"

namespace automorph {

struct MarchingOptions {
    Eigen::Vector3d low, high;  ///< corners of a box that holds the surface with a cell to spare
    double cell;                ///< edge of the cubes
};

/// Marching tetrahedra [Doi91]: every cube of a grid is split into six tetrahedra, the same way everywhere,
/// and each contributes what the linear interpolant's zero level is in it. Whatever the field, the result is
/// a closed manifold that faces outwards; its triangles are uneven. A start for remesh().
/// @param value  negative inside
/// @throws SolverFailure if the surface leaves the box or there is none
Mesh marching_tetrahedra(const std::function<double(const Eigen::Vector3d&)>& value,
                         const MarchingOptions& options);

}  // namespace automorph
