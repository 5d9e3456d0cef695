#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

enum class MapDomain {
    Disk,   ///< rays (x, y, 1)
    Sphere  ///< unit rays
};

/// A map that follows given places as far as it can be one-to-one.
struct GuidedMap {
    Points rays;
    int flipped_before = 0;  ///< triangles that the given places turn over or flatten
    int flipped = 0;         ///< those left, by the exact predicate: 0, or the map is of no use
    int moved = 0;           ///< vertices that are not at their places
    int rounds = 0;
};

/// Repairs a map that flips a few triangles: their inner corners are placed by mean value weights
/// [Floater03] of the mesh, with everything else fixed; where triangles are still flipped the region grows by
/// rings. In the disk it may grow to all inner vertices, where the answer exists; on the sphere there is no
/// such guarantee: look at `flipped`.
/// @param fixed   #V, non-zero for vertices that stay (a border)
/// @param places  #V x 3 rays
GuidedMap guided_map(const Mesh& mesh, const std::vector<char>& fixed, const Points& places,
                     MapDomain domain);

}  // namespace automorph
