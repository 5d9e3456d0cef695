#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph::bench {

/// Does the Python of Debian find Open3D (package python3-open3d)?
bool has_open3d();

struct Open3dPose {
    Eigen::Matrix3d R;  ///< proper but for rounding
    double cpu_seconds;
};

/// Rotations from the first mesh of each pair to the second as FPFH + RANSAC + ICP of Open3D find them
/// (open3d_registration.py). @throws std::runtime_error  the script failed
std::vector<Open3dPose> open3d_rotations(const std::vector<std::pair<Mesh, Mesh>>& pairs);

}  // namespace automorph::bench
