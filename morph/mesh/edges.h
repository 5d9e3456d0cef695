#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

// Connectivity of triangles that need not be a manifold: what inspection and mending look at before a
// half-edge structure can exist. No triangle may repeat a corner.

/// One side of a triangle: the edge from corner `corner` to the next.
struct EdgeUse {
    int low, high;  ///< its vertices, low < high
    int triangle, corner;
    bool forward;  ///< the triangle runs from low to high
};

/// All sides, those of one edge together, edges in order of their vertices.
struct EdgeTable {
    std::vector<EdgeUse> uses;
    std::vector<int> start;  ///< #E + 1 offsets into uses

    int edge_count() const { return static_cast<int>(start.size()) - 1; }
    int use_count(int edge) const { return start[edge + 1] - start[edge]; }
    const EdgeUse& use(int edge, int k) const { return uses[start[edge] + k]; }
};

EdgeTable edge_table(const Triangles& F);

/// A partition: label per item, 0 to count - 1 in the order of their first items.
struct Labels {
    std::vector<int> of;
    int count = 0;
};

/// Triangles joined through edges that two triangles share.
Labels edge_components(const Triangles& F, const EdgeTable& edges);

/// Corners (3 per triangle) at one vertex joined through edges that two triangles share. A vertex with more
/// than one such umbrella is not manifold.
Labels umbrellas(const Triangles& F, const EdgeTable& edges);

/// Boundary loops, where umbrellas that only touch count as apart.
int count_boundary_loops(const EdgeTable& edges, const Labels& umbrellas);

/// Which triangles to turn so that neighbours agree.
struct Orientation {
    std::vector<char> flip;     ///< per triangle; the smaller number of triangles in each component
    int conflicting_edge = -1;  ///< an edge whose triangles cannot agree (Moebius strip), or -1
};
Orientation consistent_orientation(const Triangles& F, const EdgeTable& edges, const Labels& components);

}  // namespace automorph
