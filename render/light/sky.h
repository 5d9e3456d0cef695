#pragma once

#include <memory>
#include <optional>

#include "render/light/equirectangular_map.h"
#include "render/math/vec.h"

namespace automorph::render {

/// A sky that changes from the horizon to the zenith, and what is below the horizon.
struct SkyGradient {
    Color zenith{0.15f, 0.3f, 0.7f};
    Color horizon{0.6f, 0.7f, 0.8f};
    Color ground{0.15f, 0.12f, 0.1f};
    Vec3 up{0.0f, 0.0f, 1.0f};  ///< unit

    /// Between horizon and zenith the colour changes by the root of the height.
    Color operator()(const Vec3& direction) const;
};

/// Light from all around: the sum of a constant radiance, a gradient and a map.
struct Sky {
    Color radiance{0.0f, 0.0f, 0.0f};  ///< from every direction
    std::optional<SkyGradient> gradient;
    std::shared_ptr<const EquirectangularMap> map;  ///< may be null

    /// Radiance along the unit vector `direction` without the map: so smooth that scattered rays sample it
    /// well.
    Color smooth(const Vec3& direction) const {
        return gradient ? Color(radiance + (*gradient)(direction)) : radiance;
    }

    /// Radiance of a ray that leaves the scene along the unit vector `direction`.
    Color operator()(const Vec3& direction) const {
        return map ? Color(smooth(direction) + (*map)(direction)) : smooth(direction);
    }
};

/// Irradiance that the unoccluded sky gives a surface with unit normal `normal`.
Color irradiance(const Sky& sky, const Vec3& normal);

}  // namespace automorph::render
