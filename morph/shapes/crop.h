#pragma once

#include "morph/mesh/mesh.h"
#include "morph/shapes/implicit.h"

namespace automorph {

/// The part of a closed mesh of `surface` where `side` is negative. Its border vertices lie on both zero
/// levels to rounding: vertices near the border are moved onto it, other edges across it are split there.
/// Triangle counts change by those cut off only.
/// @pre the border curve is smooth at the scale of the triangles, and `side`'s gradient is not parallel to
/// the
///      surface's on it
/// @throws SolverFailure if a border point cannot be found or nothing is left
Mesh crop(const Mesh& closed, const ImplicitSurface& surface, const ImplicitSurface& side);

}  // namespace automorph
