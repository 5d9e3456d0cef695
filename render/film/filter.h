#pragma once

#include <cstddef>
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
    float operator()(float u) const {
        if (inverse_.empty()) return u - 0.5f;
        const float place = u * kSteps;
        const auto cell = static_cast<std::size_t>(place);
        return inverse_[cell] + (place - static_cast<float>(cell)) * (inverse_[cell + 1] - inverse_[cell]);
    }

private:
    static constexpr int kSteps = 2048;  // of the table; the distribution is then met within 2e-4

    std::vector<float> inverse_;  ///< offsets at equal steps of the distribution; empty for the box
};

}  // namespace automorph::render
