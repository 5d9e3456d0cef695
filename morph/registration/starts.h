#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Starting rotations for the search over SO(3): the 60 rotations of the icosahedron, turned as a whole by a
/// random rotation (no rotation is farther than 44.5 degrees from one of them), then the 4 proper rotations that
/// align the principal axes of the two point sets. The same seed gives the same rotations everywhere.
///
/// @param source, target  #n x 3 and #m x 3, centred
std::vector<Eigen::Matrix3d> starting_rotations(const Points& source, const Points& target, std::uint64_t seed);

}  // namespace automorph
