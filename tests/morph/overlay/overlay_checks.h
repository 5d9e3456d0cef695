#pragma once

#include <string>

#include "morph/overlay/overlay.h"
#include "test_maps.h"

namespace automorph::testing {

/// Everything that must hold of an overlay of two maps, checked in exact arithmetic at a cost linear in its
/// size:
/// - a merged vertex is one of five kinds (vertex on vertex, vertex on edge, vertex in triangle, edge across
/// edge),
///   its corners belong to the meshes, it truly lies there, no two vertices have the same place, both meshes'
///   vertices are all there with weight exactly 1, and both sites are at one place to kPlaceTolerance;
/// - counts: N = N_a + N_b + crossings - coincident;
/// - faces have 3 to 6 corners, lie in both their triangles, turn strictly left at every corner, no two have
/// the same
///   pair of triangles;
/// - every merged edge has two sides, or one on the border; one component, Euler characteristic 1 or 2;
/// - the pieces of each triangle of a and of b have its area (solid angle) to rounding;
/// - each edge of a and of b is a path of merged edges.
/// Empty if all of that holds, else the first few violations.
std::string violations(const Overlay& overlay, const TestMap& a, const TestMap& b);

/// Relative to the length of the rays.
constexpr double kPlaceTolerance = 1e-12;

}  // namespace automorph::testing
