#pragma once

#include <string>
#include <utility>
#include <vector>

#include "morph/alignment/closest_point.h"
#include "morph/alignment/nonrigid.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// A shape as the alignment sees it: the surface with its openings, and how they are filled for the maps.
struct AlignedShape {
    const Mesh& mesh;                            ///< openings open
    const std::vector<std::vector<int>>& loops;  ///< longest first, as from boundary_loops
    const std::vector<int>& centres;  ///< per loop: the vertex in the middle of its filling; -1: not filled
};

/// Where a dense alignment puts the vertices of the source, fillings included.
struct Guide {
    Points x;        ///< #V x 3 in the target's frame
    Points normals;  ///< #V x 3 of the moved source; zero for the centres of fillings
    std::vector<std::pair<int, SurfacePlace>>
        pinned;                              ///< vertices of fillings and openings: places known already
    double distance = 0.0;                   ///< see NonRigidAlignment,
    int source_limbs = 0, target_limbs = 0;  ///< as these
    std::vector<std::pair<int, int>> matched_tips;
};

/// Aligns the source with the target by a smooth motion and pairs their openings.
/// @param start  #V x 3, the source's vertices moved into the target's frame by the registration
Guide align(const AlignedShape& source, const Points& start, const AlignedShape& target,
            const NonRigidOptions& options = {});

}  // namespace automorph
