#pragma once

#include <vector>

#include "morph/alignment/soft_matching.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// One step from coarse to fine of the non-rigid alignment. Lengths in units of the target's box diagonal.
struct AlignmentLevel {
    SoftMatching::Scales scales;  ///< sigma of positions and of unit normals
    double stiffness;             ///< omega
    int rounds;
};

struct NonRigidOptions {
    std::vector<AlignmentLevel> levels = {
        {{.08, .6}, .48, 3},    {{.05, .5}, .16, 3},    {{.035, .4}, .048, 4},
        {{.025, .35}, .016, 4}, {{.018, .3}, .0048, 4}, {{.012, .3}, .0016, 4},
    };
    double membrane = 1e-2, bending = 1e-4, border_bending = 3e-4;  ///< parts of the prior
    double border = 0.2;   ///< weight of a border vertex' pull to the other border, per length
    double slide = 0.95;   ///< share of that pull which is not felt along the border
    double plastic = 0.7;  ///< how much of the motion so far becomes the new shape at rest
    int similarity_rounds = 8;
};

/// A smooth motion of the source onto the target.
struct NonRigidAlignment {
    Points x;         ///< #V x 3: where each source vertex has come, in the target's frame
    double distance;  ///< root mean square distance of matches from x at the end, in target diagonals
    int factorisations = 0, iterations = 0;
};

/// Non-rigid EM-ICP: the soft matching of [Urtasun04] Sec. 4.1 continued from a rigid to a smooth motion,
/// from coarse to fine.
/// A source whose vertices all lie on the target already stays where it is.
/// @param start  #V x 3, the source's vertices moved into the target's frame by the registration
/// @param source_loops, target_loops  borders as from boundary_loops; both empty for closed shapes
NonRigidAlignment align_nonrigid(const Mesh& source, const std::vector<std::vector<int>>& source_loops,
                                 const Points& start, const Mesh& target,
                                 const std::vector<std::vector<int>>& target_loops,
                                 const NonRigidOptions& options = {});

}  // namespace automorph
