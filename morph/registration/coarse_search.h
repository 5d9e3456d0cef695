#pragma once

#include <vector>

#include "morph/registration/candidates.h"
#include "morph/registration/surface_sample.h"

namespace automorph {

/// A few steps of EM-ICP from each starting rotation, with all p_ij of Eq. (6) between two small samples
/// (about a hundred points: cheaper than a tree, vectorised, single precision), in parallel over the starts.
///
/// @param source, target  dense samples, thinned out inside
/// @param orientation_is_certain  false: the target's normals may all point the wrong way
/// @returns one candidate per start, in their order; the distance is like PoseDistance, over these small
/// samples
std::vector<Candidate> coarse_search(const SurfaceSample& source, const SurfaceSample& target,
                                     const std::vector<Eigen::Matrix3d>& starts, bool orientation_is_certain);

}  // namespace automorph
