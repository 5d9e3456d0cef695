#pragma once

#include "morph/shapes/implicit.h"
#include "morph/shapes/shapes.h"

namespace automorph {

/// The surface of star(), before the pose. @throws InvalidMesh as star() does
ImplicitSurface star_surface(const StarParameters& parameters);

}  // namespace automorph
