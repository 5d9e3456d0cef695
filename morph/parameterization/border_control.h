#pragma once

#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/registration/registration.h"

namespace automorph {

/// Where the two borders are tied together: position `source` in the source loop and `target` in the target
/// loop get angle 0. [Urtasun04] Sec. 4.2 "boundary control vertices".
struct BorderControl {
    int source = 0;                ///< index into the source loop (not a vertex)
    int target = 0;                ///< index into the target loop, as given (not reversed)
    bool target_reversed = false;  ///< the target's loop has to be run the other way round, Eq. (8)
    double responsibility =
        0.0;                   ///< p_ij of the pair; 0 when chosen without registration or by distance alone
    double convolution = 0.0;  ///< C of Eq. (8) of the direction chosen, in squared target units
    double convolution_reversed = 0.0;  ///< C of the other direction
};

/// The border pair with the largest p_ij, and the direction with the larger C.
///
/// Method     p_ij of Eq. (6), normalised over all target vertices; among equal p_ij the nearest pair, then
/// the
///            first. C of Eq. (8) over the union of the angles of either direction; source positions about
///            the source's centre of mass, turned by R and scaled, target positions about the target's.
/// Deviation  responsibilities are truncated to the nearest targets. The number of neighbours is raised until
/// no
///            pair left out can be better; if no border vertex of the target is among the nearest 1024
///            targets of any border vertex of the source, the nearest border pair is taken (responsibility
///            0).
/// @pre loops of at least 3 distinct vertices
BorderControl registered_control(const Mesh& source, const std::vector<int>& source_loop, const Mesh& target,
                                 const std::vector<int>& target_loop, const Registration& registration);

/// A mesh whose triangles face the other way, with its loop and a control that fit: what common_border wants
/// of a target whose control says `target_reversed`.
struct ReversedTarget {
    Mesh mesh;              ///< same vertices, same triangle order, corners 1 and 2 swapped
    std::vector<int> loop;  ///< the other way round, first vertex kept
    BorderControl control;  ///< `target` renumbered, `target_reversed` false
};
ReversedTarget reversed_target(const Mesh& target, const std::vector<int>& loop,
                               const BorderControl& control);

}  // namespace automorph
