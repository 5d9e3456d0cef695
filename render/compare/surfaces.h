#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "render/compare/comparison.h"
#include "render/compare/noise_tests.h"
#include "render/compare/statistical.h"

namespace automorph::render {

/// The mean shading normals of both pictures, and the noise between them: unit vectors of mean m vary by 1 -
/// m^2 at most, all coordinates together. Sums of them are held against the root of the summed variances by
/// their length, for which the bound of single numbers holds, too [Pinelis94]: all three coordinates tell at
/// once.
class NormalNoise {
public:
    /// @pre both have surfaces, of one size
    NormalNoise(const NoisyImage& golden, const NoisyImage& found);

    /// Blocks of side x side pixels that tile the picture; by signs, as those of radiance (@see
    /// compare_statistical), if sample counts are equal.
    NoiseTest block_test(int side) const;
    /// Windows of side x side pixels at all places.
    NoiseTest window_test(int side) const;

private:
    struct Pixel {
        Eigen::Vector3d difference = Eigen::Vector3d::Zero();
        double sigma = 0.0;
    };
    const Pixel& at(int x, int y) const {
        return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(x)];
    }
    double figure(const Place& place, bool by_signs) const;
    NoiseTest empty_test() const;
    /// Adds the figure of a place to a test, and returns it.
    double add(NoiseTest& test, const Place& place, bool by_signs) const;

    const Image &golden_, &found_;
    int width_, height_;
    bool equal_counts_;
    std::vector<Pixel> pixels_;
};

/// The mean albedo as a picture with noise: numbers in [0, 1] of mean m have a variance of m (1 - m) at most.
/// @pre picture.surfaces
NoisyImage noisy_albedo(const NoisyImage& picture);

/// Pixels that look at another place: whose depth differs by more than rounding. It is that of the ray
/// through the pixel's middle, which does not depend on the seed; the limit leaves room for rays that
/// rounding sends past an edge on another machine. `severity` (1 channel) becomes at least 2 there if there
/// are too many.
/// @pre both have surfaces, of one size
TestResult depth_test(const NoisyImage& golden, const NoisyImage& found, Image& severity);

}  // namespace automorph::render
