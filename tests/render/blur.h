#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/film/image.h"

/// Whether pictures with an open shutter are the mean of sharp ones.
namespace automorph::render {

inline constexpr int kBlurPairs = 32;
inline constexpr int kBlurBlock = 4;  // pixels

/// Exceeded by the largest |t| of 108 blocks in one of a thousand runs: Student's t of 31 degrees of freedom
/// at 1e-3 / 108, two-sided.
inline constexpr double kBlurLimit = 5.29;

/// Mean over channels and pixels of each block of 4 x 4 pixels.
inline std::vector<double> block_means(const Image& image) {
    const int columns = image.width / kBlurBlock, rows = image.height / kBlurBlock;
    std::vector<double> sums(static_cast<std::size_t>(columns * rows), 0.0);
    for (int y = 0; y < rows * kBlurBlock; ++y) {
        for (int x = 0; x < columns * kBlurBlock; ++x) {
            const auto block = static_cast<std::size_t>(y / kBlurBlock * columns + x / kBlurBlock);
            const auto pixel = static_cast<std::size_t>(3 * (y * image.width + x));
            for (std::size_t c = 0; c < 3; ++c) sums[block] += static_cast<double>(image.pixels[pixel + c]);
        }
    }
    for (double& sum : sums) sum /= 3 * kBlurBlock * kBlurBlock;
    return sums;
}

/// Largest |t| of any block that the differences of independent pairs have mean 0.
/// @param a, b  by pair the means of blocks
inline double largest_t(const std::vector<std::vector<double>>& a,
                        const std::vector<std::vector<double>>& b) {
    constexpr double kRounding = 1e-6;  // of radiance: blocks of the backdrop may have no noise
    const auto n = static_cast<double>(a.size());
    double largest = 0;
    for (std::size_t block = 0; block < a.front().size(); ++block) {
        double sum = 0, squares = 0;
        for (std::size_t pair = 0; pair < a.size(); ++pair) {
            const double d = a[pair][block] - b[pair][block];
            sum += d;
            squares += d * d;
        }
        const double mean = sum / n, variance = std::max(0.0, squares / n - mean * mean) / (n - 1);
        largest = std::max(largest, std::abs(mean) / std::max(std::sqrt(variance), kRounding));
    }
    return largest;
}

/// What the shutter sees, evenly: in each pair the sharp pictures stand at other moments.
/// @returns in [-0.5, 0.5] of the time the shutter is open
inline double sharp_moment(int pair, int k, int per_pair) {
    return (pair + kBlurPairs * k + 0.5) / (kBlurPairs * per_pair) - 0.5;
}

}  // namespace automorph::render
