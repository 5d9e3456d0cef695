#pragma once

#include <algorithm>
#include <string>

#include "render/compare/comparison.h"
#include "render/compare/pixel_noise.h"
#include "render/film/image.h"

/// The figures that tell change from noise, of blocks and windows of a NoiseMap.
namespace automorph::render {

inline constexpr int kSmallBlock = 8, kLargeBlock = 32;  ///< pixels
inline constexpr int kWindow = 3;                        ///< pixels

/// Calls visit(Place) for the blocks of side x side pixels that tile a picture, row by row; those at its
/// right and lower side may be smaller. Channel 0.
template <class Visit>
void for_each_block(int width, int height, int side, const Visit& visit) {
    for (int y = 0; y < height; y += side) {
        for (int x = 0; x < width; x += side)
            visit(Place{x, y, std::min(side, width - x), std::min(side, height - y), 0});
    }
}
/// The same for the windows of side x side pixels at all places.
template <class Visit>
void for_each_window(int width, int height, int side, const Visit& visit) {
    for (int y = 0; y + side <= height; ++y) {
        for (int x = 0; x + side <= width; ++x) visit(Place{x, y, side, side, 0});
    }
}

/// What one of `count` figures exceeds by noise with a probability of at most `rate`.
double limit_for(double count, double rate);

/// A test in the making: the largest figure of the picture, of how many, and those of all pixels.
struct NoiseTest {
    TestResult result;
    double count = 0.0;
    Image figures;           ///< 1 channel, the largest of the channels; empty for the whole picture
    bool is_coarse = false;  ///< its figures are shown only where they are above the limit

    void add(double figure, const Place& where);
    /// Shows a figure in all pixels of a block, which no other shares; in the middle one of a window, if it
    /// is the largest there.
    void show_block(const Place& block, double figure);
    void show_window(const Place& window, double figure);
};

/// What a block says: the share of noise in `sum` has mean 0 and a standard deviation of `scale`, or less.
struct BlockSums {
    double sum = 0.0, scale = 0.0, signal = 0.0;  ///< signal: what `sum` would be if all radiance doubled

    double figure() const { return scale > 0.0 ? std::abs(sum) / scale : 0.0; }
};

BlockSums sums_of(const NoiseMap& noise, const Place& place);

/// Sum over the pixels of a window.
PixelNoise window_noise(const NoiseMap& noise, const Place& place);

/// Blocks of side x side pixels that tile the picture.
NoiseTest block_test(const NoiseMap& noise, int side);
/// The whole picture as one block.
NoiseTest whole_test(const NoiseMap& noise);
/// Windows of side x side pixels at all places.
NoiseTest window_test(const NoiseMap& noise, int side);

}  // namespace automorph::render
