#pragma once

#include "render/math/vec.h"

namespace automorph::render {

/// What a surface is made of. Both sides are alike.
struct Material {
    Color albedo{0.7f, 0.7f, 0.7f};    ///< diffuse reflectance, in [0, 1]
    Color emission{0.0f, 0.0f, 0.0f};  ///< radiance; found by camera and scattered rays only: for large faint
                                       ///< sources. Small bright ones belong in a RectangleLight.
    /// Seen by the camera, the surface takes the albedo with which it would have the background's radiance if
    /// nothing stood on it: a ground that shows shadows only and has no horizon. To other rays it is
    /// `albedo`.
    bool shadow_catcher = false;
};

}  // namespace automorph::render
