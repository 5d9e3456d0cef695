#include "render/bsdf/diffuse.h"

#include <algorithm>
#include <cmath>

namespace automorph::render {
namespace {

// Taylor polynomials, exact to single precision where |x| <= pi/4: the next terms are 2e-9 and 3e-8.
float sine(float x) {
    const float x2 = x * x;
    return x * (1.0f + x2 * (-1.0f / 6 + x2 * (1.0f / 120 + x2 * (-1.0f / 5040 + x2 * (1.0f / 362880)))));
}

float cosine(float x) {
    const float x2 = x * x;
    return 1.0f + x2 * (-0.5f + x2 * (1.0f / 24 + x2 * (-1.0f / 720 + x2 * (1.0f / 40320))));
}

}  // namespace

Eigen::Vector2f sample_disk(float u, float v) {
    const float a = 2.0f * u - 1.0f;
    const float b = 2.0f * v - 1.0f;
    if (std::abs(a) > std::abs(b)) {
        const float angle = 0.25f * kPi * (b / a);
        return {a * cosine(angle), a * sine(angle)};
    }
    if (b == 0.0f) return {0.0f, 0.0f};
    const float angle = 0.25f * kPi * (a / b);
    return {b * sine(angle), b * cosine(angle)};
}

BsdfSample Diffuse::sample(float u, float v) const {
    const Eigen::Vector2f disk = sample_disk(u, v);
    // Malley's method. The lift stays above the horizon, so that pdf and weight are never 0/0.
    constexpr float kLowest = 1e-6f;
    const float z2 = 1.0f - disk.squaredNorm();
    const float z = std::max(kLowest, std::sqrt(std::max(0.0f, z2)));
    return {{disk.x(), disk.y(), z}, albedo_, z * kInvPi};
}

}  // namespace automorph::render
