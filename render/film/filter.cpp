#include "render/film/filter.h"

#include <cmath>
#include <cstddef>

namespace automorph::render {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kRadius = 1.5;  // pixels

// Integral of the four-term Blackman-Harris window (Harris 1978) over [0, x] of its length 1, over the whole.
double distribution(double x) {
    const double sines = -0.48829 / kTwoPi * std::sin(kTwoPi * x) +
                         0.14128 / (2 * kTwoPi) * std::sin(2 * kTwoPi * x) -
                         0.01168 / (3 * kTwoPi) * std::sin(3 * kTwoPi * x);
    return x + sines / 0.35875;
}

double invert(double probability) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (distribution(middle) < probability ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

FilterSampler::FilterSampler(Filter filter) {
    if (filter == Filter::Box) return;
    inverse_.resize(kSteps + 1);
    for (int i = 0; i <= kSteps; ++i) {
        inverse_[static_cast<std::size_t>(i)] =
            static_cast<float>(kRadius * (2.0 * invert(static_cast<double>(i) / kSteps) - 1.0));
    }
}

}  // namespace automorph::render
