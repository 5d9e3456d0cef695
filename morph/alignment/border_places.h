#pragma once

#include <optional>
#include <vector>

#include "morph/alignment/closest_point.h"
#include "morph/mesh/mesh.h"
#include "morph/parameterization/border_union.h"

namespace automorph {

/// Angles on the target's loop (arc length from its first vertex, as arc_length_angles) for the vertices of
/// an aligned source loop: those of the nearest points, made monotone (running maximum and minimum averaged)
/// with a little of the source's own arc length mixed in, so that no two coincide. Empty if the aligned loop
/// does not run once around the target's in its direction.
/// @param aligned  #source loop x 3, in the target's frame
/// @param target   #target loop x 3
std::optional<Eigen::VectorXd> monotone_angles(const Points& aligned, const Points& target);

/// Both borders with one polygon, the source's vertices at the places the alignment gives them. Empty as
/// above.
std::optional<BorderUnion> aligned_border(const Points& aligned, const Points& target);

/// The point of a mesh at an angle of one of its loops.
SurfacePlace place_on_loop(const std::vector<int>& loop, const Eigen::VectorXd& loop_angles, double angle);

}  // namespace automorph
