#pragma once

#include <Eigen/Core>
#include <cmath>

#include "render/math/vec.h"

namespace automorph::render {

/// A point of the unit disk for (u, v) in [0, 1)^2: area-preserving and continuous [Shirley97]. Like
/// angle_of() it uses no function of the C library whose last bit depends on the machine.
inline Eigen::Vector2f sample_disk(float u, float v) {
    const float a = 2.0f * u - 1.0f, b = 2.0f * v - 1.0f;
    const bool wide = std::abs(a) > std::abs(b);
    const float radius = wide ? a : b;
    const float x = radius != 0.0f ? 0.25f * kPi * ((wide ? b : a) / radius) : 0.0f;  // |x| <= pi / 4
    // Taylor polynomials, exact to single precision: the next terms are 2e-9 and 3e-8.
    const float x2 = x * x;
    const float sine =
        x * (1.0f + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 * (1.0f / 362880)))));
    const float cosine = 1.0f + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 * (1.0f / 40320))));
    return radius * (wide ? Eigen::Vector2f(cosine, sine) : Eigen::Vector2f(sine, cosine));
}

}  // namespace automorph::render
