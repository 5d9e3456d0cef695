#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/film/image.h"

namespace automorph::render {

/// The sky of a clear day, zenith +Z, 512 x 256 texels: blue to the zenith, dark below the horizon, a sun of
/// radiance 200 within three degrees of (1, -1, 1), a warm patch about (-0.8, -0.6, 0). The map from
/// directions to texels is that of EquirectangularMap with its default axes.
inline Image day_sky() {
    constexpr double pi = std::numbers::pi, degrees = 180.0 / pi;
    Image sky(512, 256);
    for (int row = 0; row < sky.height; ++row) {
        for (int column = 0; column < sky.width; ++column) {
            const double phi = 2.0 * pi * ((column + 0.5) / sky.width - 0.5);
            const double t = pi * (0.5 - (row + 0.5) / sky.height);
            const Eigen::Vector3d d(std::cos(phi) * std::cos(t), -std::sin(phi) * std::cos(t), std::sin(t));
            Eigen::Array3d L(0.15, 0.12, 0.1);
            if (d.z() >= 0.0) {
                const double w = std::sqrt(d.z());
                L = (1.0 - w) * Eigen::Array3d(0.6, 0.7, 0.8) + w * Eigen::Array3d(0.15, 0.3, 0.7);
            }
            const double sun =
                degrees * std::acos(std::min(1.0, d.dot(Eigen::Vector3d(1, -1, 1).normalized())));
            L += std::clamp(4.0 - sun, 0.0, 1.0) * Eigen::Array3d(200, 180, 150);
            const double patch = degrees * std::acos(std::min(1.0, d.dot(Eigen::Vector3d(-0.8, -0.6, 0))));
            if (patch < 20.0 && d.z() > 0.0) L += Eigen::Array3d(3, 1.5, 0.5);
            for (int c = 0; c < 3; ++c) sky.at(column, row)[c] = static_cast<float>(L[c]);
        }
    }
    return sky;
}

/// Radiance of a white diffuse plane that looks up to it: the sum over texels with their exact solid angles.
inline constexpr double kDaySkyPlane[] = {0.69846, 0.78214, 1.04857};

}  // namespace automorph::render
