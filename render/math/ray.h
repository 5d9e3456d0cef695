#pragma once

#include "render/math/vec.h"

namespace automorph::render {

/// A ray in world space at a moment of the exposure.
struct Ray {
    Vec3 origin;
    Vec3 direction;     ///< unit
    float time = 0.0f;  ///< in [0, 1]: from the opening of the shutter to its closing
};

}  // namespace automorph::render
