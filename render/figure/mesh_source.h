#pragma once

#include <string>

#include "morph/morph.h"
#include "render/figure/config.h"

namespace automorph {

/// Reads or generates the mesh a config asks for and places it in the world.
/// @param name  how errors and reports call a generated shape; a file is called by its path
/// @throws IoError, InvalidMesh
InputMesh make_mesh(const MeshConfig& config, const std::string& name);

/// The turn as a matrix.
Eigen::Matrix3d rotation_matrix(const MeshConfig::Turn& turn);

}  // namespace automorph
