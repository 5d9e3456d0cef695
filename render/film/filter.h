#pragma once

#include <vector>

namespace automorph::render {

/// Pixel reconstruction filter.
enum class Filter {
    Box,            ///< one pixel wide
    BlackmanHarris  ///< the four-term window, 3 pixels wide (about 1 pixel at half height)
};

/// Samples a pixel filter by its own density (filter importance sampling, [Ernst06]): every sample then
/// counts the same and belongs to one pixel, so that pixels do not depend on each other.
class FilterSampler {
public:
    explicit FilterSampler(Filter filter);

    /// Offset from the pixel's centre along one axis, in pixels, for u in [0, 1). Increases with u.
    float operator()(float u) const;

private:
    std::vector<float> inverse_;  ///< offsets at equal steps of the distribution; empty for the box
};

}  // namespace automorph::render
