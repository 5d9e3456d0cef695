#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

struct GuardedMove {
    Points rays;        ///< #V x 3, unit vectors
    int shortened = 0;  ///< vertices that did not go the whole way
};

/// Moves the vertices of a valid map onto the sphere towards other places, as far as the map stays valid: the
/// moves of the corners of bad triangles are halved until there are none. Only those: one bad triangle does
/// not hold up the rest. A triangle whose corners all stay is never bad.
/// @param rays    #V x 3, unit vectors, every triangle positive
/// @param wanted  #V x 3, unit vectors less than pi away; equal to `rays` where a vertex is to stay
GuardedMove move_guarded(const Triangles& F, const Points& rays, const Points& wanted);

}  // namespace automorph
