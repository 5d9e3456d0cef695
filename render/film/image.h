#pragma once

#include <cstddef>
#include <vector>

namespace automorph::render {

/// A picture of interleaved 32-bit floats, linear Rec.709/sRGB primaries, row 0 at the top.
/// Three channels are R, G, B; one is grey.
struct Image {
    int width = 0;
    int height = 0;
    int channels = 3;
    std::vector<float> pixels;  ///< height x width x channels

    Image() = default;
    /// A picture filled with `value`. @pre all sizes >= 0
    Image(int width_, int height_, int channels_ = 3, float value = 0.0f)
        : width(width_),
          height(height_),
          channels(channels_),
          pixels(static_cast<std::size_t>(width_) * height_ * channels_, value) {}

    /// The channels of the pixel in column x, row y. @pre 0 <= x < width, 0 <= y < height
    float* at(int x, int y) { return &pixels[(static_cast<std::size_t>(y) * width + x) * channels]; }
    const float* at(int x, int y) const {
        return &pixels[(static_cast<std::size_t>(y) * width + x) * channels];
    }
};

}  // namespace automorph::render
