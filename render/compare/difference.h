#pragma once

#include <cstddef>

#include "render/compare/comparison.h"
#include "render/film/image.h"

namespace automorph::render {

/// How picture `b` differs from `a`, over all channels. All are 0 for equal pictures; NaN in one picture but
/// not in the other makes them infinite.
struct Difference {
    double rmse = 0.0;           ///< root of the mean squared difference
    double relative_bias = 0.0;  ///< (mean b - mean a) / mean a
    double max_block = 0.0;      ///< largest |mean difference| of an 8 x 8 pixel block, in radiance
    Place max_block_place;
    double max_pixel = 0.0;  ///< largest |difference| of a pixel's channel
    Place max_pixel_place;
    std::size_t different_values = 0;  ///< channels of pixels that are not bit-equal
};

/// The side of the blocks, pixels; those at the right and lower border may be smaller.
constexpr int kBlock = 8;

/// @throws Error if sizes or channels differ
void require_same_shape(const Image& a, const Image& b);

/// @throws Error likewise
Difference compare(const Image& a, const Image& b);

/// |difference| of each pixel, the largest of its channels: 1 channel. @throws Error likewise
Image absolute_difference(const Image& a, const Image& b);

/// Mean of the place's channel.
double mean(const Image& image, const Place& place);

}  // namespace automorph::render
