#pragma once

#include <vector>

#include "morph/registration/procrustes.h"
#include "morph/registration/surface_sample.h"

namespace automorph {

/// A pose and how badly the two shapes agree in it.
struct Candidate {
    RigidMotion motion;
    double distance = 0.0;
};

struct CoarseSearchOptions {
    int iterations = 6;                      ///< of EM-ICP, from each starting rotation
    bool orientation_is_certain = true;      ///< false: the target's normals may all point the wrong way
};

/// A few steps of EM-ICP from each starting rotation, with all p_ij of Eq. (6) between two small samples (some
/// hundred points: cheaper than a tree, vectorised, single precision), in parallel over the starts. The distance
/// is the symmetric trimmed one of PoseDistance, over these samples. One candidate per start, in their order.
std::vector<Candidate> coarse_search(const SurfaceSample& source, const SurfaceSample& target,
                                     const std::vector<Eigen::Matrix3d>& starts,
                                     const CoarseSearchOptions& options = {});

}  // namespace automorph
