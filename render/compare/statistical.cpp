#include "render/compare/statistical.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/compare/difference.h"
#include "render/compare/pixel_noise.h"

namespace automorph::render {
namespace {

constexpr int kSmallBlock = 8, kLargeBlock = 32;  // pixels
constexpr int kWindow = 3;                        // pixels

/// What one of `count` figures exceeds by noise with a probability of at most `rate`.
double limit_for(double count, double rate) {
    return std::sqrt(2.0 * std::log(2.0 * count / rate));
}

/// A test in the making: the largest figure of the picture, of how many, and those of all pixels.
struct NoiseTest {
    TestResult result;
    double count = 0.0;
    Image figures;           // 1 channel, the largest of the channels; empty for the whole picture
    bool is_coarse = false;  // its figures are shown only where they are above the limit

    void add(double figure, const Place& where) {
        count += 1.0;
        if (figure <= result.value && result.where.width > 0) return;
        result.value = figure;
        result.where = where;
    }
};

/// What a block says: the share of noise in `sum` has mean 0 and a standard deviation of `scale`, or less.
struct BlockSums {
    double sum = 0.0, scale = 0.0, signal = 0.0;  // signal: what `sum` would be if all radiance doubled

    double figure() const { return scale > 0.0 ? std::abs(sum) / scale : 0.0; }
};

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

double even_change(const NoiseMap& noise, double limit) {
    double least = std::numeric_limits<double>::infinity();
    for (int c = 0; c < 3; ++c) {
        const BlockSums sums = sums_of(noise, {0, 0, noise.width(), noise.height(), c});
        if (sums.signal > 0.0) least = std::min(least, limit * sums.scale / sums.signal);
    }
    return least;
}

double local_change(const NoiseMap& noise, double limit) {
    std::vector<double> sigmas;
    for (int y = 0; y + kWindow <= noise.height(); ++y) {
        for (int x = 0; x + kWindow <= noise.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                const double sigma = window_noise(noise, {x, y, kWindow, kWindow, c}).sigma;
                if (sigma > 0.0) sigmas.push_back(sigma);
            }
        }
    }
    if (sigmas.empty()) return 0.0;
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    return limit * *middle / (kWindow * kWindow);
}

double root_mean(const Image& variance) {
    double sum = 0.0;
    for (const float each : variance.pixels) sum += each;
    return std::sqrt(sum / static_cast<double>(variance.pixels.size()));
}

std::vector<NoiseTest> all_tests(const NoiseMap& noise) {
    std::vector<NoiseTest> tests;
    for (const int side : {kSmallBlock, kLargeBlock}) {
        if (noise.width() > side || noise.height() > side) tests.push_back(block_test(noise, side));
    }
    tests.push_back(whole_test(noise));
    tests.push_back(window_test(noise, 1));
    if (std::min(noise.width(), noise.height()) >= kWindow) tests.push_back(window_test(noise, kWindow));
    return tests;
}

TestResult finite_test(const NoiseMap& noise) {
    TestResult test;
    test.name = "not finite";
    test.value = static_cast<double>(noise.not_finite());
    test.where = noise.not_finite_place();
    return test;
}

}  // namespace

StatisticalComparison compare_statistical(const NoisyImage& golden, const NoisyImage& found,
                                          const StatisticalOptions& options) {
    const NoiseMap noise(golden, found);
    std::vector<NoiseTest> tests = all_tests(noise);
    StatisticalComparison comparison;
    comparison.severity = Image(noise.width(), noise.height(), 1);
    comparison.severity_unit = "limit";
    const double rate_of_each = options.false_alarm_rate / static_cast<double>(tests.size());
    for (NoiseTest& test : tests) {
        TestResult& result = test.result;
        result.limit = limit_for(test.count, rate_of_each);
        result.chance = std::min(1.0, 2.0 * test.count * std::exp(-0.5 * result.value * result.value));
        const auto limit = static_cast<float>(result.limit);
        for (std::size_t i = 0; i < test.figures.pixels.size(); ++i) {
            const float share = test.figures.pixels[i] / limit;
            if (test.is_coarse && share <= 1.0f) continue;
            comparison.severity.pixels[i] = std::max(comparison.severity.pixels[i], share);
        }
        comparison.tests.push_back(result);
    }
    if (noise.not_finite() > 0) comparison.tests.push_back(finite_test(noise));
    for (TestResult& test : comparison.tests) {
        test.golden = mean(golden.image, test.where);
        test.found = mean(found.image, test.where);
    }
    comparison.sensitivity = {even_change(noise, limit_for(3.0, rate_of_each)),
                              local_change(noise, limit_for(tests.back().count, rate_of_each)),
                              root_mean(golden.variance), root_mean(found.variance)};
    return comparison;
}

}  // namespace automorph::render
