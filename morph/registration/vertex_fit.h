#pragma once

#include "morph/mesh/mesh.h"
#include "morph/registration/procrustes.h"

namespace automorph {

/// The motion that lays the vertices of a mesh exactly on those of its re-posed copy, where the target is
/// one: sampling noise is uncalled for then. Any other pair keeps its motion.
///
/// @param source, target  size-normalised, #n x 3 and #m x 3
/// @param start  close to the answer: vertices within 0.02 of their copies, on average
RigidMotion settled_on_vertices(const Points& source, const Points& target, const RigidMotion& start);

/// sigma_p of Eq. (7): the mean distance from a source vertex to its nearest target vertex. Of a source with
/// more than 20000 vertices every k-th is asked.
///
/// @param moved  #n x 3, source vertices in the target's frame
/// @param target  #m x 3
double mean_nearest_distance(const Points& moved, const Points& target);

}  // namespace automorph
