#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Vertices of two maps nearer than this on the domain (radius 1) become one; a mesh over its own map turned
/// by 1e-9 would otherwise grow to nine times its vertices. Far below the resolution of any map that is
/// looked at.
constexpr double kSnap = 1e-7;

/// Moves inner vertices of a map onto the nearest vertex of another map within kSnap, and within kSnapShare
/// of their shortest edge, one-to-one. A move that would turn a triangle (by the exact predicate) is not
/// made. Returns the number of vertices moved.
/// @param loop   border vertices of `mesh`: they stay
/// @param rays   #V x 3 map of `mesh`, changed in place
/// @param onto   rays of the other map
int snap_vertices(const Mesh& mesh, const std::vector<int>& loop, Points& rays, const Points& onto);

}  // namespace automorph
