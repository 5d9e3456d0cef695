#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "render/image/image_file.h"

namespace automorph::render {
namespace {

// Linear value at which the code rounds from i to i + 1. The curve increases, so comparing with these is the
// same as encoding and rounding, and does not depend on the last bit of powf.
template <class Code>
auto make_thresholds() {
    constexpr std::size_t kCodes = std::numeric_limits<Code>::max();
    std::array<float, kCodes> thresholds;
    for (std::size_t i = 0; i < kCodes; ++i)
        thresholds[i] = from_srgb((static_cast<double>(i) + 0.5) / static_cast<double>(kCodes));
    return thresholds;
}

template <class Code>
Code to_code(float linear) {
    static const auto thresholds = make_thresholds<Code>();
    if (std::isnan(linear)) return 0;
    return static_cast<Code>(std::upper_bound(thresholds.begin(), thresholds.end(), linear) -
                             thresholds.begin());
}

}  // namespace

std::uint8_t to_srgb8(float linear) {
    return to_code<std::uint8_t>(linear);
}

std::uint16_t to_srgb16(float linear) {
    return to_code<std::uint16_t>(linear);
}

float from_srgb(double code) {
    return static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
}

float from_srgb8(std::uint8_t code) {
    return from_srgb(code / 255.0);
}

float filmic(float linear) {
    constexpr float kBright = 1e4f;  // white long before, and its square is finite
    const float x = std::clamp(linear, 0.0f, kBright);
    return std::min(1.0f, x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f));
}

}  // namespace automorph::render
