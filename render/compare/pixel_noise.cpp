#include "render/compare/pixel_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "morph/mesh/errors.h"
#include "render/compare/difference.h"

namespace automorph::render {
namespace {

constexpr double kRounding = 1e-5;     // relative: what compilers and processors change in a sum of paths
constexpr double kEqualCounts = 0.01;  // relative difference of all samples up to which they count as equal

void check(const NoisyImage& picture, const char* name) {
    require_same_shape(picture.image, picture.variance);
    for (int y = 0; y < picture.image.height; ++y) {
        for (int x = 0; x < picture.image.width; ++x) {
            const float count = *picture.samples.at(x, y);
            if (!(count >= 2.0f)) {
                throw Error(
                    fmt::format("pixel ({}, {}) of the {} picture has {} samples; its noise is "
                                "known from 2 on: render it with more, or compare as same-seed",
                                x, y, name, count));
            }
            for (int c = 0; c < 3; ++c) {
                const float variance = picture.variance.at(x, y)[c];
                if (!(variance >= 0.0f)) {
                    throw Error(
                        fmt::format("pixel ({}, {}) of the {} picture has the variance {}; "
                                    "expected a number from 0 on",
                                    x, y, name, variance));
                }
            }
        }
    }
}

double total(const Image& samples) {
    double sum = 0.0;
    for (const float count : samples.pixels) sum += count;
    return sum;
}

}  // namespace

// Welch's variance fails where the smaller picture missed rare bright samples, the pooled one where it met
// them by luck; so the larger one is taken. With equal counts they differ by d^2 / (2 n - 1) only.
double noise_sigma(const Sampled& a, const Sampled& b, double difference) {
    const double welch = a.variance + b.variance;
    const double all = a.count + b.count;
    // Sums of squares about the pictures' own means, and that between them: of all samples about one mean.
    const double within = a.count * (a.count - 1.0) * a.variance + b.count * (b.count - 1.0) * b.variance;
    const double between = a.count * b.count / all * difference * difference;
    const double pooled = (within + between) / (all - 1.0) * (1.0 / a.count + 1.0 / b.count);
    return std::sqrt(std::max(welch, pooled));
}

NoiseMap::NoiseMap(const NoisyImage& golden, const NoisyImage& found)
    : width_(golden.image.width), height_(golden.image.height) {
    require_same_shape(golden.image, found.image);
    check(golden, "golden");
    check(found, "new");
    const double all_golden = total(golden.samples), all_found = total(found.samples);
    equal_counts_ = std::abs(all_golden - all_found) <= kEqualCounts * std::max(all_golden, all_found);

    pixels_.reserve(golden.image.pixels.size());
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            for (int c = 0; c < 3; ++c) {
                const Sampled a{golden.image.at(x, y)[c], golden.variance.at(x, y)[c],
                                *golden.samples.at(x, y)};
                const Sampled b{found.image.at(x, y)[c], found.variance.at(x, y)[c], *found.samples.at(x, y)};
                PixelNoise pixel;
                if (std::isfinite(a.mean) && std::isfinite(b.mean)) {
                    const double rounding = kRounding * std::max(std::abs(a.mean), std::abs(b.mean));
                    const double whole = b.mean - a.mean;
                    pixel.difference = std::copysign(std::max(0.0, std::abs(whole) - rounding), whole);
                    pixel.golden = a.mean;
                    pixel.sigma = noise_sigma(a, b, pixel.difference);
                } else if (std::isfinite(a.mean) != std::isfinite(b.mean)) {
                    if (not_finite_ == 0) not_finite_place_ = {x, y, 1, 1, c};
                    ++not_finite_;
                }
                pixels_.push_back(pixel);
            }
        }
    }
}

}  // namespace automorph::render
