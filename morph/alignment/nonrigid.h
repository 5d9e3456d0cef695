#pragma once

#include <utility>
#include <vector>

#include "morph/alignment/options.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// A smooth motion of the source onto the target.
struct NonRigidAlignment {
    Points x;               ///< #V x 3: where each source vertex has come, in the target's frame
    double distance = 0.0;  ///< root mean square distance of matches from x at the end, in target diagonals
    int factorisations = 0, iterations = 0;
    int source_limbs = 0, target_limbs = 0;  ///< found (limbs.h)
    std::vector<std::pair<int, int>>
        matched_tips{};  ///< vertices of source and target at the tips of matched limbs
};

/// Non-rigid EM-ICP: the soft matching of [Urtasun04] Sec. 4.1 continued from a rigid to a smooth motion,
/// from coarse to fine.
/// Cost  bounded by options.vertices: larger meshes are thinned out (coarse.h), and the motion of the coarse
///       source is carried over to the vertices of the whole.
/// Limbs that belong together are laid on one another at the coarse levels (limb_pull.h).
/// A source whose vertices all lie on the target already stays where it is.
/// @param start  #V x 3, the source's vertices moved into the target's frame by the registration
/// @param source_loops, target_loops  borders as from boundary_loops; both empty for closed shapes
NonRigidAlignment align_nonrigid(const Mesh& source, const std::vector<std::vector<int>>& source_loops,
                                 const Points& start, const Mesh& target,
                                 const std::vector<std::vector<int>>& target_loops,
                                 const NonRigidOptions& options = {});

}  // namespace automorph
