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

void NoiseTest::show_block(const Place& block, double figure) {
    for (int y = block.y; y < block.y + block.height; ++y)
        std::fill_n(figures.at(block.x, y), block.width, static_cast<float>(figure));
}

void NoiseTest::show_window(const Place& window, double figure) {
    float& shown = *figures.at(window.x + window.width / 2, window.y + window.height / 2);
    shown = std::max(shown, static_cast<float>(figure));
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
    for_each_block(noise.width(), noise.height(), side, [&](Place block) {
        double worst = 0.0;
        for (block.channel = 0; block.channel < 3; ++block.channel) {
            const double figure = sums_of(noise, block).figure();
            test.add(figure, block);
            worst = std::max(worst, figure);
        }
        test.show_block(block, worst);
    });
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
    for_each_window(noise.width(), noise.height(), side, [&](Place window) {
        for (window.channel = 0; window.channel < 3; ++window.channel) {
            const PixelNoise sum = window_noise(noise, window);
            const double figure = sum.sigma > 0.0 ? std::abs(sum.difference) / sum.sigma : 0.0;
            test.add(figure, window);
            test.show_window(window, figure);
        }
    });
    return test;
}

}  // namespace automorph::render
