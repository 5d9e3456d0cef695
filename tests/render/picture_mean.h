#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "render/film/image.h"
#include "render/integrator/render.h"

// Numbers of pictures for the tests of the path tracer.
namespace automorph::render {

struct Mean {
    double value, error;  // over pixels, and its standard error
};

inline Mean mean_red(const Image& image) {
    double sum = 0.0, squares = 0.0;
    const int pixels = image.width * image.height;
    for (int i = 0; i < pixels; ++i) {
        const auto x = static_cast<double>(image.pixels[static_cast<std::size_t>(3 * i)]);
        sum += x;
        squares += x * x;
    }
    const double mean = sum / pixels;
    return {mean, std::sqrt(std::max(0.0, squares / pixels - mean * mean) / (pixels - 1))};
}

inline bool same_bits(const Image& a, const Image& b) {
    return a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

inline RenderOptions small_picture(int size, int spp) {
    RenderOptions options;
    options.width = options.height = size;
    options.spp = spp;
    options.filter = Filter::Box;
    return options;
}

}  // namespace automorph::render
