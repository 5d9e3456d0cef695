#pragma once

#include <optional>
#include <vector>

#include "render/film/image.h"
#include "render/light/light.h"
#include "render/math/vec.h"

namespace automorph::render {

/// How the picture of a sky is turned: unit vectors, right-handed in this order.
struct MapAxes {
    Vec3 middle{1.0f, 0.0f, 0.0f};  ///< of the picture
    Vec3 left{0.0f, 1.0f, 0.0f};    ///< middle of its left half
    Vec3 zenith{0.0f, 0.0f, 1.0f};  ///< its upper edge
};

/// A sky from a latitude-longitude picture, constant in each texel, sampled in proportion to its radiance.
///
/// Row 0 lies at the zenith. In coordinates along the axes (middle, left, zenith), with u to the right and v
/// downwards, both in [0, 1], and phi = 2 pi (u - 1/2), elevation t = pi (1/2 - v), the direction is (cos phi
/// cos t, -sin phi cos t, sin t).
class EquirectangularMap {
public:
    /// @param image  one or three channels of linear radiance
    /// @throws ConfigError if the picture is empty, has other channels or a value that is negative or not
    /// finite
    explicit EquirectangularMap(const Image& image, const MapAxes& axes = {});

    /// Radiance from the unit vector `direction`.
    Color operator()(const Vec3& direction) const { return color(texel(direction)); }

    /// A direction for (u, v) in [0, 1)^2; empty if the map is black.
    std::optional<LightSample> sample(float u, float v) const;

    /// Density of sample(), per solid angle.
    float pdf(const Vec3& direction) const { return density(color(texel(direction))); }

    /// Integral of the radiance over all directions, mean of the three channels.
    float power() const { return static_cast<float>(power_); }

    /// Irradiance of an unoccluded surface with unit normal `normal`.
    Color irradiance(const Vec3& normal) const;

private:
    std::size_t texel(const Vec3& direction) const;
    Color color(std::size_t texel) const { return Color(&texels_[3 * texel]); }
    float density(const Color& c) const {
        return power_ > 0.0 ? c.mean() / static_cast<float>(power_) : 0.0f;
    }
    double solid_angle(int row) const;  ///< of each of its texels

    MapAxes axes_;
    int width_, height_;
    std::vector<float> texels_;   ///< height x width x 3
    std::vector<float> rows_;     ///< height + 1: distribution of the row
    std::vector<float> columns_;  ///< height x (width + 1): distribution of the column in each row
    std::vector<double> edges_;   ///< height + 1: sine of the elevation of the rows' edges
    double power_ = 0.0;
};

}  // namespace automorph::render
