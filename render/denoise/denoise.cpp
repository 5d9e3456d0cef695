#include "render/denoise/denoise.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "morph/mesh/errors.h"

namespace automorph::render {
namespace {

constexpr int kBandRows = 16;         // that a thread takes at a time
constexpr float kNoVariance = 1e-7f;  // squared radiance below which differences are not noise

void check(const Image& image, const Image& layer, int channels, const char* name) {
    if (layer.width == image.width && layer.height == image.height && layer.channels == channels) return;
    throw Error(fmt::format("denoise: layer {} has {} x {} pixels and {} channels; expected {} x {} and {}",
                            name, layer.width, layer.height, layer.channels, image.width, image.height,
                            channels));
}

/// The variance as its neighbourhood shows it: that of a pixel alone is as noisy as the pixel.
Image smoothed(const Image& variance) {
    constexpr int kRadius = 1;
    Image smooth(variance.width, variance.height);
    for (int y = 0; y < variance.height; ++y) {
        for (int x = 0; x < variance.width; ++x) {
            int count = 0;
            float* sum = smooth.at(x, y);
            for (int j = std::max(0, y - kRadius); j <= std::min(variance.height - 1, y + kRadius); ++j) {
                for (int i = std::max(0, x - kRadius); i <= std::min(variance.width - 1, x + kRadius); ++i) {
                    for (int c = 0; c < 3; ++c) sum[c] += variance.at(i, j)[c];
                    ++count;
                }
            }
            for (int c = 0; c < 3; ++c) sum[c] /= static_cast<float>(count);
        }
    }
    return smooth;
}

float squared_difference(const float* a, const float* b) {
    float sum = 0.0f;
    for (int c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
}

/// About exp(-x), exactly 1 at 0 and 0 from 8 on; products only, so that it rounds alike everywhere.
float falling(float x) {
    const float t = std::max(0.0f, 1.0f - 0.125f * x), t2 = t * t, t4 = t2 * t2;
    return t4 * t4;
}

class BilateralFilter {
public:
    BilateralFilter(const Image& image, const Layers& layers, const DenoiseOptions& options)
        : image_(image), layers_(layers), options_(options), variance_(smoothed(layers.variance)) {}

    Image run() const {
        Image result(image_.width, image_.height);
        const int bands = (image_.height + kBandRows - 1) / kBandRows;
        tbb::parallel_for(tbb::blocked_range<int>(0, bands, 1), [&](const tbb::blocked_range<int>& range) {
            for (int band = range.begin(); band != range.end(); ++band) filter_band(band * kBandRows, result);
        });
        return result;
    }

private:
    /// Mean over the channels of what two pixels differ beyond their noise, relative to it.
    float color_distance(int x, int y, int i, int j) const {
        const float* a = image_.at(x, y);
        const float* b = image_.at(i, j);
        const float* va = variance_.at(x, y);
        const float* vb = variance_.at(i, j);
        float sum = 0.0f;
        for (int c = 0; c < 3; ++c) {
            const float difference = a[c] - b[c];
            const float noise = va[c] + std::min(va[c], vb[c]);
            sum += (difference * difference - noise) /
                   (kNoVariance + options_.color * options_.color * (va[c] + vb[c]));
        }
        return sum / 3.0f;
    }

    /// What the first surfaces differ; above 8 they are not mixed.
    float feature_distance(int x, int y, int i, int j) const {
        constexpr float kApart = 1e6f;
        const float depth = *layers_.depth.at(x, y), other = *layers_.depth.at(i, j);
        const bool here = std::isfinite(depth), there = std::isfinite(other);
        float sum = squared_difference(layers_.shading_normal.at(x, y), layers_.shading_normal.at(i, j)) /
                        (options_.normal * options_.normal) +
                    squared_difference(layers_.albedo.at(x, y), layers_.albedo.at(i, j)) /
                        (options_.albedo * options_.albedo);
        return here == there ? sum : kApart;
    }

    void filter_band(int first, Image& result) const;

    const Image& image_;
    const Layers& layers_;
    const DenoiseOptions& options_;
    Image variance_;
};

// One offset of the window after the other, so that the mean over patches is a running sum.
void BilateralFilter::filter_band(int first, Image& result) const {
    const int width = image_.width, height = image_.height, patch = options_.patch;
    const int rows = std::min(kBandRows, height - first), tall = rows + 2 * patch;
    const auto cells = static_cast<std::size_t>(width);
    std::vector<float> distance(cells * static_cast<std::size_t>(tall)), across(distance.size());
    std::vector<float> weights(cells * static_cast<std::size_t>(rows)), sums(3 * weights.size());
    const auto clamped = [](int value, int size) { return std::clamp(value, 0, size - 1); };
    for (int dy = -options_.radius; dy <= options_.radius; ++dy) {
        for (int dx = -options_.radius; dx <= options_.radius; ++dx) {
            for (int r = 0; r < tall; ++r) {
                const int y = clamped(first + r - patch, height), j = clamped(y + dy, height);
                float* row = &distance[static_cast<std::size_t>(r) * cells];
                for (int x = 0; x < width; ++x) row[x] = color_distance(x, y, clamped(x + dx, width), j);
                float* mean = &across[static_cast<std::size_t>(r) * cells];
                for (int x = 0; x < width; ++x) {
                    float sum = 0.0f;
                    for (int k = -patch; k <= patch; ++k) sum += row[clamped(x + k, width)];
                    mean[x] = sum;
                }
            }
            const auto side = static_cast<float>(2 * patch + 1);
            for (int r = 0; r < rows; ++r) {
                const int y = first + r, j = y + dy;
                if (j < 0 || j >= height) continue;
                for (int x = std::max(0, -dx); x < std::min(width, width - dx); ++x) {
                    float sum = 0.0f;
                    for (int k = 0; k <= 2 * patch; ++k)
                        sum += across[static_cast<std::size_t>(r + k) * cells + static_cast<std::size_t>(x)];
                    const float apart = std::max(0.0f, sum / (side * side));
                    if (apart >= 8.0f) continue;
                    const float weight = falling(apart) * falling(feature_distance(x, y, x + dx, j));
                    const std::size_t at = static_cast<std::size_t>(r) * cells + static_cast<std::size_t>(x);
                    weights[at] += weight;
                    for (std::size_t c = 0; c < 3; ++c) sums[3 * at + c] += weight * image_.at(x + dx, j)[c];
                }
            }
        }
    }
    // The pixel itself has weight 1, so no sum is zero.
    for (std::size_t at = 0; at < weights.size(); ++at) {
        float* to = result.at(0, first) + 3 * at;
        for (std::size_t c = 0; c < 3; ++c) to[c] = sums[3 * at + c] / weights[at];
    }
}

}  // namespace

Image denoise(const Image& image, const Layers& layers, const DenoiseOptions& options) {
    check(image, image, 3, "radiance");
    check(image, layers.albedo, 3, "albedo");
    check(image, layers.shading_normal, 3, "shading_normal");
    check(image, layers.depth, 1, "depth");
    check(image, layers.variance, 3, "variance");
    return BilateralFilter(image, layers, options).run();
}

}  // namespace automorph::render
