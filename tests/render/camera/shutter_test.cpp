#include "render/camera/shutter.h"

#include <cmath>

#include "tests/catch.h"

using namespace automorph::render;

TEST_CASE("a shutter opens as long before a picture's moment as it closes after it, evenly") {
    CHECK(shutter_times(0.5, 1) == std::vector<double>{0.0});
    CHECK(shutter_times(0.5, 3) == std::vector<double>{-0.25, 0.0, 0.25});
    CHECK(shutter_times(1.0, 5) == std::vector<double>{-0.5, -0.25, 0.0, 0.25, 0.5});
}

TEST_CASE(
    "between two moments an arc is left by no more than 0.00035 of its radius, up to what Embree takes") {
    CHECK(shutter_steps(0) == 1);
    for (const double degrees : {0.01, 1.0, 6.0, 6.1, -90.0, 384.0}) {
        const int steps = shutter_steps(degrees);
        INFO(degrees << " " << steps);
        CHECK(steps % 2 == 1);
        REQUIRE(steps >= 3);
        const double half_arc = 0.5 * std::abs(degrees) / (steps - 1) / 57.29577951308232;
        CHECK(1 - std::cos(half_arc) < 0.00035);
        // With two moments less, it would be more, but for the three that any motion has.
        if (steps > 3) CHECK(1 - std::cos(half_arc * (steps - 1) / (steps - 3)) > 0.00034);
    }
    CHECK(shutter_steps(1e9) == 129);
}
