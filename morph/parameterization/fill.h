#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A mesh whose openings are closed by fans.
struct FilledMesh {
    Mesh mesh;                     ///< input vertices and triangles keep their indices; new ones follow
    std::vector<char> is_filling;  ///< per triangle: non-zero if it belongs to a fan
    std::vector<int> centres;      ///< per loop: the centre vertex of its fan
};

/// Fills boundary loops (as from boundary_loops: in the direction of the triangles beside them) with a fan
/// about the mean of the loop's vertices. METHOD "Openings". The fan's triangles face like their neighbours.
/// @throws InvalidMesh  a loop has fewer than 3 vertices or names a vertex that is not there
FilledMesh fill_openings(const Mesh& mesh, const std::vector<std::vector<int>>& loops);

}  // namespace automorph
