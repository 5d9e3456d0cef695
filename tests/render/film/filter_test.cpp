#include "render/film/filter.h"

#include <cmath>

#include "tests/catch.h"

using namespace automorph::render;

namespace {

// The four-term window, its middle at 0, of the width of the filter.
double window(double x) {
    const double t = 2.0 * 3.14159265358979324 * (x / 3.0 + 0.5);
    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

}  // namespace

TEST_CASE("the box filter covers the pixel evenly") {
    const FilterSampler box(Filter::Box);
    for (float u : {0.0f, 0.25f, 0.5f, 0.875f}) CHECK(box(u) == u - 0.5f);
}

TEST_CASE("the Blackman-Harris sampler inverts the window's distribution") {
    const FilterSampler sampler(Filter::BlackmanHarris);
    // The window's integral up to the offset for u is u. Midpoint rule, upwards along with u.
    constexpr int kSteps = 300000;
    const auto place = [](int i) { return 3.0 * (i + 0.5) / kSteps - 1.5; };
    double total = 0.0;
    for (int i = 0; i < kSteps; ++i) total += window(place(i));
    double sum = 0.0;
    int reached = 0;
    for (int k = 0; k < 20000; ++k) {
        const double u = (k + 0.5) / 20000;
        const double offset = sampler(static_cast<float>(u));
        while (reached < kSteps && place(reached) < offset) sum += window(place(reached++)) / total;
        CHECK(sum == Approx(u).margin(2.1e-4));
    }
}

TEST_CASE("offsets increase with the number, are symmetric and stay within the filter") {
    for (Filter filter : {Filter::Box, Filter::BlackmanHarris}) {
        const FilterSampler sampler(filter);
        const float radius = filter == Filter::Box ? 0.5f : 1.5f;
        float before = -radius;
        for (int i = 0; i < 4096; ++i) {
            const float u = static_cast<float>(i) / 4096.0f;
            const float x = sampler(u);
            CHECK(x >= before);
            CHECK(x < radius);
            if (i > 0) CHECK(x == Approx(-sampler(1.0f - u)).margin(1e-5));
            before = x;
        }
        CHECK(sampler(0x0.ffffffp0f) <= radius);
    }
}
