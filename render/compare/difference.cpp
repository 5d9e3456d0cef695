#include "render/compare/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "morph/mesh/errors.h"

namespace automorph::render {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double difference(float a, float b) {
    if (std::memcmp(&a, &b, sizeof a) == 0) return 0.0;  // equal infinities and NaNs, too
    if (std::isnan(a) && std::isnan(b)) return 0.0;
    const double d = static_cast<double>(b) - a;
    return std::isnan(d) ? kInfinity : d;
}

void find_largest_block(const Image& a, const Image& b, Difference& result) {
    for (int y0 = 0; y0 < a.height; y0 += kBlock) {
        for (int x0 = 0; x0 < a.width; x0 += kBlock) {
            const int x1 = std::min(x0 + kBlock, a.width), y1 = std::min(y0 + kBlock, a.height);
            for (int c = 0; c < a.channels; ++c) {
                double sum = 0.0;
                for (int y = y0; y < y1; ++y) {
                    for (int x = x0; x < x1; ++x) sum += difference(a.at(x, y)[c], b.at(x, y)[c]);
                }
                double block = std::abs(sum / ((x1 - x0) * (y1 - y0)));
                if (std::isnan(block)) block = kInfinity;
                if (block <= result.max_block) continue;
                result.max_block = block;
                result.max_block_place = {x0, y0, x1 - x0, y1 - y0, c};
            }
        }
    }
}

}  // namespace

void require_same_shape(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height || a.channels != b.channels) {
        throw Error(
            fmt::format("pictures cannot be compared: {} x {} with {} channels against {} x {} with {}",
                        a.width, a.height, a.channels, b.width, b.height, b.channels));
    }
}

Difference compare(const Image& a, const Image& b) {
    require_same_shape(a, b);
    Difference result;
    double squares = 0.0, sum = 0.0, sum_a = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double d = difference(a.pixels[i], b.pixels[i]);
        squares += d * d;
        sum += d;
        sum_a += a.pixels[i];
        if (std::memcmp(&a.pixels[i], &b.pixels[i], sizeof(float)) != 0) ++result.different_values;
        if (std::abs(d) > result.max_pixel) {
            const auto channels = static_cast<std::size_t>(a.channels);
            const int pixel = static_cast<int>(i / channels);
            result.max_pixel = std::abs(d);
            result.max_pixel_place = {pixel % a.width, pixel / a.width, 1, 1, static_cast<int>(i % channels)};
        }
    }
    if (!a.pixels.empty()) result.rmse = std::sqrt(squares / static_cast<double>(a.pixels.size()));
    if (sum != 0.0) result.relative_bias = std::isnan(sum / sum_a) ? kInfinity : sum / sum_a;
    find_largest_block(a, b, result);
    return result;
}

Image absolute_difference(const Image& a, const Image& b) {
    require_same_shape(a, b);
    Image result(a.width, a.height, 1);
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        float& pixel = result.pixels[i / static_cast<std::size_t>(a.channels)];
        pixel = std::max(pixel, static_cast<float>(std::abs(difference(a.pixels[i], b.pixels[i]))));
    }
    return result;
}

double mean(const Image& image, const Place& place) {
    double sum = 0.0;
    for (int y = place.y; y < place.y + place.height; ++y) {
        for (int x = place.x; x < place.x + place.width; ++x) sum += image.at(x, y)[place.channel];
    }
    return sum / std::max(1, place.width * place.height);
}

}  // namespace automorph::render
