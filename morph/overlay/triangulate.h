#pragma once

#include <vector>

#include "morph/overlay/overlay.h"

namespace automorph {

/// Triangles of the merged connectivity and the merged face each belongs to.
struct MergedTriangles {
    Triangles F;
    std::vector<int> face;  ///< #F, index of the merged face
};

/// Triangulates the convex merged faces. Of all triangulations of a face (14 for a hexagon) the one is taken
/// whose worst triangle over both shapes is best: 4 sqrt(3) area / (sum of squared sides), negative where it
/// faces against its triangle of a or b. [Urtasun04] Sec. 4.4.
/// @param points_a  #merged x 3, merged vertices on shape a; points_b likewise
MergedTriangles triangulate(const Overlay& overlay, const Mesh& a, const Points& points_a, const Mesh& b,
                            const Points& points_b);

}  // namespace automorph
