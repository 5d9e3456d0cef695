#pragma once

#include "render/math/vec.h"

namespace automorph::render {

/// The same radiance from every direction.
struct Sky {
    Color radiance{0.0f, 0.0f, 0.0f};

    /// Radiance of a ray that leaves the scene along the unit vector `direction`.
    Color operator()(const Vec3& direction) const {
        static_cast<void>(direction);
        return radiance;
    }
};

}  // namespace automorph::render
