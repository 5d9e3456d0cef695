#pragma once

#include "morph/mesh/mesh.h"
#include "morph/registration/nearest.h"
#include "morph/registration/procrustes.h"

namespace automorph {

struct EmIcpOptions {
    int max_iterations = 100;
    int neighbours = 8;  ///< nearest targets kept in each row of p_ij; the others count as 0
    double motion_tolerance =
        1e-4;  ///< stop below this change per step: turn (radians) + shift (target units)
};

struct EmIcpResult {
    RigidMotion motion;  ///< the one of smallest sigma met on the way
    double sigma = 0.0;  ///< Eq. (7) at `motion`, in target units
    int iterations = 0;
    bool converged = false;
};

/// EM-ICP [Granger02], [Urtasun04] Sec. 4.1, from a starting motion. Each step computes sigma_p (7), which
/// may rise, the responsibilities p_ij (6), and the motion that minimises sum p_ij d_ij^2 (5).
///
/// Deviation  steps that keep their direction are extrapolated [Besl92]: the same optimum in a tenth of the
/// steps. Cost       per step, one query of the k-d tree for each source point, shared among threads; the
/// result does
///            not depend on their number.
///
/// @param source  #n x 3, n > 0, every point counts alike
/// @param target  tree over #m x 3, m > 0
EmIcpResult em_icp(const Points& source, const NearestPoints<3>& target, const RigidMotion& start,
                   const EmIcpOptions& options = {});

/// The last step of the way, beyond the paper: the same p_ij, but a distance counts fully along the target's
/// normal and little across it (Chen and Medioni 1992, Segal 2009). Two samples of one surface have no points
/// in common, and with Eq. (5) their chance gaps hold a smooth shape degrees away from its pose; the planes
/// do not. Stops where EM-ICP would, or where small steps get no smaller: on shapes that differ the pose
/// swings about its place. The caller decides whether the motion is better.
///
/// @param target_normals  #m x 3, one per point of the tree, of either sign
EmIcpResult polish_along_normals(const Points& source, const NearestPoints<3>& target,
                                 const Points& target_normals, const RigidMotion& start,
                                 const EmIcpOptions& options = {});

}  // namespace automorph
