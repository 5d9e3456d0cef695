#pragma once

#include <vector>

#include "morph/alignment/closest_point.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// For each aligned point its place on the target: the closest point whose normal agrees; where none does, a
/// point of the triangle nearest in place and normal.
/// @param points, normals  #n x 3 in the target's frame; normals unit or zero (then every normal agrees)
std::vector<SurfacePlace> places_on(const Mesh& target, const Points& points, const Points& normals);

}  // namespace automorph
