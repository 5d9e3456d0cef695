#pragma once

#include <vector>

#include "morph/merge_maps.h"
#include "morph/parameterization/border_union.h"
#include "morph/registration/registration.h"

namespace automorph {

/// A shape with openings filled for the maps.
struct FilledShape {
    Shape shape;
    std::vector<std::vector<int>> loops;  ///< of the mesh as it was; longest first
    std::vector<int> centres;             ///< per loop: the centre of its filling; -1: it stays open
};

/// Fills these openings.
FilledShape filled_shape(const Mesh& mesh, const std::vector<std::vector<int>>& openings);

/// Two open shapes tied together at their borders, the longest loops; further openings are filled.
struct OpenPair {
    FilledShape source, target;
    Mesh target_mesh;              ///< unfilled, and turned over if `target_reversed`
    bool target_reversed = false;  ///< its border ran the other way, Eq. (8)
    BorderUnion border;            ///< of source.loops[0] and target.loops[0]
};

/// Control vertices, direction and border insertion, [Urtasun04] Sec. 4.2.
/// @param registration  none: Section 3 alone, an arbitrary start and the meshes' own directions
OpenPair open_pair(const Mesh& source, const Mesh& target, const Registration* registration);

}  // namespace automorph
