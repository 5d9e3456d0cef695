#pragma once

#include <vector>

#include "render/compare/statistical.h"

namespace automorph::render {

/// By how much a channel of a pixel differs, and the standard deviation of such differences by noise alone.
struct PixelNoise {
    double difference = 0.0;  ///< found - golden, radiance; 0 within rounding
    double golden = 0.0;      ///< radiance; 0 where it is not finite
    double sigma = 0.0;       ///< radiance; above 0 where `difference` is not 0
};

/// A mean of samples of a pixel in one of the pictures: `variance` is that of the mean.
struct Sampled {
    double mean, variance, count;
};

/// Standard deviation of the difference of two such means, by noise alone: the larger of Welch's estimate and
/// the pooled one.
double noise_sigma(const Sampled& a, const Sampled& b, double difference);

/// The noise of all pixels and channels of two pictures.
class NoiseMap {
public:
    /// @throws Error as compare_statistical() does
    NoiseMap(const NoisyImage& golden, const NoisyImage& found);

    int width() const { return width_; }
    int height() const { return height_; }
    const PixelNoise& at(int x, int y, int channel) const {
        return pixels_[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                        static_cast<std::size_t>(x)) *
                           3 +
                       static_cast<std::size_t>(channel)];
    }

    /// Whether both pictures took as many samples, so that their noise has one distribution.
    bool equal_counts() const { return equal_counts_; }

    /// Values that are finite in one of the pictures only, and the first such place. Their noise is 0, as
    /// that of values that are finite in neither.
    std::size_t not_finite() const { return not_finite_; }
    const Place& not_finite_place() const { return not_finite_place_; }

private:
    int width_, height_;
    std::vector<PixelNoise> pixels_;  // height x width x 3
    bool equal_counts_ = false;
    std::size_t not_finite_ = 0;
    Place not_finite_place_;
};

}  // namespace automorph::render
