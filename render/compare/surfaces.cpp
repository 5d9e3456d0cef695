#include "render/compare/surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/compare/difference.h"
#include "render/compare/pixel_noise.h"

namespace automorph::render {
namespace {

constexpr double kRoundedSquare = 1e-6;  // error of squared lengths and shares in single precision
constexpr double kRoundedDepth = 1e-4;   // relative: of places seen at a slant
constexpr double kStrayPixels = 2.0;     // that may look past an edge, and their share in large pictures
constexpr double kStrayShare = 1e-4;

double variance_of_mean(double variance_of_one, float count) {
    return (std::max(0.0, variance_of_one) + kRoundedSquare) / std::max(1.0, count - 1.0);
}

Eigen::Vector3d normal_at(const Image& image, int x, int y) {
    return Eigen::Map<const Eigen::Vector3f>(image.at(x, y)).cast<double>();
}

bool same_depth(float a, float b) {
    if (a == b) return true;  // both infinite, too
    return std::abs(static_cast<double>(a) - b) <= kRoundedDepth * std::abs(static_cast<double>(a));
}

}  // namespace

NormalNoise::NormalNoise(const NoisyImage& golden, const NoisyImage& found)
    : golden_(golden.surfaces->shading_normal),
      found_(found.surfaces->shading_normal),
      width_(golden.image.width),
      height_(golden.image.height),
      equal_counts_(golden.samples.pixels == found.samples.pixels) {
    require_same_shape(golden_, golden.image);
    require_same_shape(found_, golden_);
    pixels_.reserve(golden.samples.pixels.size());
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            const Eigen::Vector3d a = normal_at(golden_, x, y), b = normal_at(found_, x, y);
            const float n = *golden.samples.at(x, y), m = *found.samples.at(x, y);
            Pixel pixel;
            if (a.allFinite() && b.allFinite()) {
                const Sampled sampled_a{0.0, variance_of_mean(1.0 - a.squaredNorm(), n), n},
                    sampled_b{0.0, variance_of_mean(1.0 - b.squaredNorm(), m), m};
                pixel.difference = b - a;
                pixel.sigma = noise_sigma(sampled_a, sampled_b, pixel.difference.norm());
            }
            pixels_.push_back(pixel);
        }
    }
}

double NormalNoise::figure(const Place& place, bool by_signs) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double squares = 0.0;
    for (int y = place.y; y < place.y + place.height; ++y) {
        for (int x = place.x; x < place.x + place.width; ++x) {
            const Pixel& pixel = at(x, y);
            if (!(pixel.sigma > 0.0)) continue;
            const Eigen::Vector3d difference =
                by_signs ? Eigen::Vector3d(pixel.difference / pixel.sigma) : pixel.difference;
            sum += difference;
            squares += by_signs ? difference.squaredNorm() : pixel.sigma * pixel.sigma;
        }
    }
    return squares > 0.0 ? sum.norm() / std::sqrt(squares) : 0.0;
}

NoiseTest NormalNoise::empty_test() const {
    NoiseTest test;
    test.result.channels = {"x", "y", "z"};
    test.figures = Image(width_, height_, 1);
    return test;
}

// The channel is that which differs most.
double NormalNoise::add(NoiseTest& test, const Place& place, bool by_signs) const {
    const double value = figure(place, by_signs);
    Place where = place;
    double most = 0.0;
    for (int c = 0; c < 3; ++c) {
        const Place each{place.x, place.y, place.width, place.height, c};
        const double change = std::abs(mean(found_, each) - mean(golden_, each));
        if (change > most) where.channel = c;
        most = std::max(most, change);
    }
    test.add(value, where);
    return value;
}

NoiseTest NormalNoise::block_test(int side) const {
    NoiseTest test = empty_test();
    test.result.name = fmt::format("normal, blocks {} x {}", side, side);
    for_each_block(width_, height_, side,
                   [&](const Place& block) { test.show_block(block, add(test, block, equal_counts_)); });
    return test;
}

NoiseTest NormalNoise::window_test(int side) const {
    NoiseTest test = empty_test();
    test.result.name =
        side == 1 ? "normal, single pixels" : fmt::format("normal, windows {} x {}", side, side);
    for_each_window(width_, height_, side,
                    [&](const Place& window) { test.show_window(window, add(test, window, false)); });
    return test;
}

NoisyImage noisy_albedo(const NoisyImage& picture) {
    const Image& albedo = picture.surfaces->albedo;
    require_same_shape(albedo, picture.image);
    NoisyImage noisy{albedo, Image(albedo.width, albedo.height), picture.samples};
    for (int y = 0; y < albedo.height; ++y) {
        for (int x = 0; x < albedo.width; ++x) {
            for (int c = 0; c < 3; ++c) {
                const double m = albedo.at(x, y)[c];
                noisy.variance.at(x, y)[c] =
                    static_cast<float>(variance_of_mean(m * (1.0 - m), *picture.samples.at(x, y)));
            }
        }
    }
    return noisy;
}

TestResult depth_test(const NoisyImage& golden, const NoisyImage& found, Image& severity) {
    const Image &a = golden.surfaces->depth, &b = found.surfaces->depth;
    require_same_shape(a, b);
    require_same_shape(a, severity);
    TestResult test;
    test.name = "other depth, pixels";
    test.channels = {"depth"};
    test.limit = std::max(kStrayPixels, kStrayShare * a.width * a.height);
    std::vector<std::size_t> differing;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        if (!same_depth(a.pixels[i], b.pixels[i])) differing.push_back(i);
    }
    test.value = static_cast<double>(differing.size());
    if (differing.empty()) return test;
    const auto width = static_cast<std::size_t>(a.width);
    const std::size_t first = differing.front();
    test.where = {static_cast<int>(first % width), static_cast<int>(first / width), 1, 1, 0};
    test.golden = a.pixels[first];
    test.found = b.pixels[first];
    if (!test.passed()) {
        for (const std::size_t i : differing) severity.pixels[i] = std::max(2.0f, severity.pixels[i]);
    }
    return test;
}

}  // namespace automorph::render
