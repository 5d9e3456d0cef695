#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Per triangle: it passes through another one that shares no vertex with it, an edge of one properly
/// crossing the inside of the other. Touching is no crossing, and triangles without area cross nothing. Cost
/// n log n for surfaces; pairs come from Embree's collision of boxes, decided in doubles.
/// @throws SolverFailure Embree could not be started
std::vector<char> self_intersecting(const Mesh& mesh);

}  // namespace automorph
