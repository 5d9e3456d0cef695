#pragma once

#include <cstddef>

#include "render/film/image.h"

namespace automorph::render {

/// How picture `b` differs from `a`, over all channels. All are 0 for equal pictures; NaN in one picture but
/// not in the other makes them infinite.
struct Difference {
    double rmse = 0.0;           ///< root of the mean squared difference
    double relative_bias = 0.0;  ///< (mean b - mean a) / mean a
    double max_block = 0.0;      ///< largest |mean difference| of an 8 x 8 pixel block, in radiance
    double max_pixel = 0.0;      ///< largest |difference| of a pixel's channel
    int max_pixel_x = 0, max_pixel_y = 0;
    std::size_t different_values = 0;  ///< channels of pixels that are not bit-equal
};

/// @throws Error if sizes or channels differ
Difference compare(const Image& a, const Image& b);

}  // namespace automorph::render
