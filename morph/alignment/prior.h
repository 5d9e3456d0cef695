#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// How a motion u of a mesh (#V x 3) is kept smooth: energies u^T A u, each a symmetric positive semidefinite
/// #V x #V matrix with the constants in its kernel.
struct MotionPrior {
    Eigen::SparseMatrix<double> membrane;  ///< cotangent Laplacian L: integral of |grad u|^2, no unit
    Eigen::SparseMatrix<double> bending;   ///< L_in^T M^-1 L_in: integral of (laplace u)^2, per squared
                                           ///< length; rows of L at inner vertices only: the border bends
                                           ///< freely, and so does a hub of more than 200 neighbours
    Eigen::SparseMatrix<double> border;    ///< along the loops: integral of |u'|^2, per length
};

/// The priors of a mesh in the given shape; `loops` as from boundary_loops.
/// Deviation  cotangents are bounded as in weight_matrix(), and negative edge weights count as zero, so that
/// the
///            membrane stays positive semidefinite on any mesh; masses are at least 1e-3 of the mean.
MotionPrior motion_prior(const Mesh& mesh, const std::vector<std::vector<int>>& loops);

}  // namespace automorph
