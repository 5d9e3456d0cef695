#pragma once

#include "morph/mesh/mesh.h"

namespace automorph {

struct SelfIntersections {
    int triangles = 0;  ///< that pass through others
    bool estimated = false;
};

/// Triangles that pass through another one with which they share no vertex, an edge of one properly crossing
/// the inside of the other. Touching is no crossing, and triangles without area cross nothing.
/// Costs n log n for surfaces: the pairs whose boxes overlap, from Embree, decided in doubles. Where all
/// boxes overlap (a fan of thousands of needles, a tangle) there are n^2 of these.
/// @param most_pairs  if there are more pairs, by a sample, so many are looked at, and the count is an
/// estimate
/// @throws SolverFailure Embree could not be started
SelfIntersections self_intersections(const Mesh& mesh, double most_pairs = 2e7);

}  // namespace automorph
