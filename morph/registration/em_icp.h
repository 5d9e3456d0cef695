#pragma once

#include "morph/mesh/mesh.h"
#include "morph/registration/nearest.h"
#include "morph/registration/procrustes.h"

namespace automorph {

struct EmIcpOptions {
    int max_iterations = 100;
    int neighbours = 8;               ///< nearest targets kept in each row of p_ij; the others count as 0
    double motion_tolerance = 1e-5;   ///< stop below this change per step: turn (radians) + shift (target units)
};

struct EmIcpResult {
    RigidMotion motion;      ///< the one of smallest sigma met on the way
    double sigma = 0.0;      ///< Eq. (7) at `motion`, in target units
    int iterations = 0;
    bool converged = false;
};

/// EM-ICP [Granger02], [Urtasun04] Sec. 4.1, from a starting motion. Each step computes sigma_p (7), which may
/// rise, the responsibilities p_ij (6), and the motion that minimises sum p_ij d_ij^2 (5).
/// Cost per step: source.rows() queries of the k-d tree, shared among threads; same result for any number of them.
///
/// @param source  #n x 3, n > 0, every point counts alike
/// @param target  tree over #m x 3, m > 0
EmIcpResult em_icp(const Points& source, const NearestPoints<3>& target, const RigidMotion& start,
                   const EmIcpOptions& options = {});

/// One row of Eq. (6): p_j = exp(-d_j^2 / 2 sigma^2) / sum_k exp(-d_k^2 / 2 sigma^2), computed relative to the
/// nearest target, so that no row underflows to zero: in the limit of small sigma the nearest has p = 1.
///
/// @param squared_distances  #k, ascending
/// @param p                  #k, the result, of sum 1
void responsibility_row(const double* squared_distances, int k, double sigma, double* p);

}  // namespace automorph
