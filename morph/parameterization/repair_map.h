#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

struct RepairedMap {
    Points rays;      ///< #V x 3: (x, y, 1)
    int flipped = 0;  ///< triangles with det <= 0 that are left, by the exact predicate
    int moved = 0;    ///< vertices in another place than before
};

/// Removes flipped triangles from a map that is nearly one-to-one (rounding of very small triangles):
/// vertices about flipped triangles are moved, one at a time, into the kernel of their star (the points that
/// see the whole star), or towards their neighbours where that kernel is empty; a move counts only if no
/// triangle of the star is flipped anew, by the exact predicate. While flips remain the region grows by
/// rings, so that room is made from outside. Deterministic.
/// @param fixed  #V, non-zero for border vertices
RepairedMap repair_map(const Mesh& mesh, const std::vector<char>& fixed, const Points& rays);

}  // namespace automorph
