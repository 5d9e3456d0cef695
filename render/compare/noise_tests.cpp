#include "render/compare/noise_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace automorph::render {

double limit_for(double count, double rate) {
    return std::sqrt(2.0 * std::log(2.0 * count / rate));
}

void NoiseTest::add(double figure, const Place& where) {
    count += 1.0;
    if (figure <= result.value && result.where.width > 0) return;
    result.value = figure;
    result.where = where;
}

// With equal counts of samples, signs are all that is left to chance: pixels may be weighted by what both
// pictures say together, and their own squares are the scale. Else one sign is the likelier one in skewed
// distributions, so that only plain differences have mean 0.
BlockSums sums_of(const NoiseMap& noise, const Place& place) {
    BlockSums sums;
    double squares = 0.0;
    for (int y = place.y; y < place.y + place.height; ++y) {
        for (int x = place.x; x < place.x + place.width; ++x) {
            const PixelNoise& pixel = noise.at(x, y, place.channel);
            if (!(pixel.sigma > 0.0)) continue;
            const double weight = noise.equal_counts() ? 1.0 / pixel.sigma : 1.0;
            const double spread = noise.equal_counts() ? weight * pixel.difference : pixel.sigma;
            sums.sum += weight * pixel.difference;
            sums.signal += weight * pixel.golden;
            squares += spread * spread;
        }
    }
    sums.scale = std::sqrt(squares);
    return sums;
}

NoiseTest block_test(const NoiseMap& noise, int side) {
    NoiseTest test;
    test.result.name = fmt::format("blocks {} x {}", side, side);
    test.figures = Image(noise.width(), noise.height(), 1);
    test.is_coarse = side > kSmallBlock;
    for (int y0 = 0; y0 < noise.height(); y0 += side) {
        for (int x0 = 0; x0 < noise.width(); x0 += side) {
            const int width = std::min(side, noise.width() - x0),
                      height = std::min(side, noise.height() - y0);
            double worst = 0.0;
            for (int c = 0; c < 3; ++c) {
                const Place block{x0, y0, width, height, c};
                const double figure = sums_of(noise, block).figure();
                test.add(figure, block);
                worst = std::max(worst, figure);
            }
            for (int y = y0; y < y0 + height; ++y)
                std::fill_n(test.figures.at(x0, y), width, static_cast<float>(worst));
        }
    }
    return test;
}

NoiseTest whole_test(const NoiseMap& noise) {
    NoiseTest test;
    test.result.name = "whole picture";
    for (int c = 0; c < 3; ++c) {
        const Place all{0, 0, noise.width(), noise.height(), c};
        test.add(sums_of(noise, all).figure(), all);
    }
    return test;
}

PixelNoise window_noise(const NoiseMap& noise, const Place& place) {
    PixelNoise sum;
    double variance = 0.0;
    for (int y = place.y; y < place.y + place.height; ++y) {
        for (int x = place.x; x < place.x + place.width; ++x) {
            const PixelNoise& pixel = noise.at(x, y, place.channel);
            sum.difference += pixel.difference;
            variance += pixel.sigma * pixel.sigma;
        }
    }
    sum.sigma = std::sqrt(variance);
    return sum;
}

NoiseTest window_test(const NoiseMap& noise, int side) {
    NoiseTest test;
    test.result.name = side == 1 ? "single pixels" : fmt::format("windows {} x {}", side, side);
    test.figures = Image(noise.width(), noise.height(), 1);
    for (int y = 0; y + side <= noise.height(); ++y) {
        for (int x = 0; x + side <= noise.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                const Place window{x, y, side, side, c};
                const PixelNoise sum = window_noise(noise, window);
                const double figure = sum.sigma > 0.0 ? std::abs(sum.difference) / sum.sigma : 0.0;
                test.add(figure, window);
                float& shown = *test.figures.at(x + side / 2, y + side / 2);
                shown = std::max(shown, static_cast<float>(figure));
            }
        }
    }
    return test;
}

}  // namespace automorph::render
