#pragma once

#include <limits>

#include "render/math/vec.h"

namespace automorph::render {

/// A direction towards a light, sampled with density `pdf`.
struct LightSample {
    Vec3 to_light;     ///< from the lit point to the sampled point of the light, not normalised; wi for a sky
    Vec3 wi;           ///< unit
    Color radiance;    ///< arriving at the lit point if nothing is between
    float pdf;         ///< per solid angle at the lit point
    float far = 1.0f;  ///< the light's distance in lengths of `to_light`; infinite for a sky
};

/// Where a ray meets the radiating side of a light.
struct LightHit {
    float distance;  ///< in lengths of the direction
    float pdf;       ///< density of sample() for this direction, per solid angle
};

}  // namespace automorph::render
