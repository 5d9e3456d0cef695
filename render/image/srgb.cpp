#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "render/image/image_file.h"

namespace automorph::render {
namespace {

// IEC 61966-2-1: code value in [0, 1] to linear.
double decode(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

// Linear value at which the code rounds from i to i + 1. The curve increases, so comparing with these is the
// same as encoding and rounding, and does not depend on the last bit of powf.
std::array<float, 255> make_thresholds() {
    std::array<float, 255> thresholds;
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
        thresholds[i] = static_cast<float>(decode((static_cast<double>(i) + 0.5) / 255.0));
    }
    return thresholds;
}

}  // namespace

std::uint8_t to_srgb8(float linear) {
    static const std::array<float, 255> thresholds = make_thresholds();
    if (std::isnan(linear)) return 0;
    return static_cast<std::uint8_t>(std::upper_bound(thresholds.begin(), thresholds.end(), linear) -
                                     thresholds.begin());
}

float from_srgb8(std::uint8_t code) {
    return static_cast<float>(decode(code / 255.0));
}

}  // namespace automorph::render
