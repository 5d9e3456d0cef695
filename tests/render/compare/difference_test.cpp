#include "render/compare/difference.h"

#include <cmath>
#include <limits>

#include "morph/mesh/errors.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::render;

TEST_CASE("equal pictures do not differ, even where they are not finite") {
    Image a(20, 12, 3, 0.5f);
    a.pixels[5] = std::numeric_limits<float>::quiet_NaN();
    a.pixels[7] = std::numeric_limits<float>::infinity();
    const Difference d = compare(a, a);
    CHECK(d.rmse == 0.0);
    CHECK(d.relative_bias == 0.0);
    CHECK(d.max_block == 0.0);
    CHECK(d.max_pixel == 0.0);
    CHECK(d.different_values == 0);
}

TEST_CASE("one changed value gives the closed forms") {
    const Image a(20, 12, 3, 0.5f);  // blocks: 8 x 8 first, 4 x 4 last
    Image b = a;
    b.at(18, 9)[2] += 0.25f;
    const Difference d = compare(a, b);
    CHECK(d.rmse == Approx(0.25 / std::sqrt(720.0)));
    CHECK(d.relative_bias == Approx(0.25 / 360.0));
    CHECK(d.max_block == Approx(0.25 / 16));
    CHECK(d.max_pixel == Approx(0.25));
    CHECK(d.max_pixel_place.x == 18);
    CHECK(d.max_pixel_place.y == 9);
    CHECK(d.max_pixel_place.channel == 2);
    CHECK(d.max_block_place.x == 16);
    CHECK(d.max_block_place.y == 8);
    CHECK(d.max_block_place.width == 4);
    CHECK(d.max_block_place.height == 4);
    CHECK(mean(b, d.max_block_place) == Approx(0.5 + 0.25 / 16));
    const Image map = absolute_difference(a, b);
    CHECK(*map.at(18, 9) == 0.25f);
    CHECK(*map.at(9, 9) == 0.0f);
    CHECK(d.different_values == 1);
    CHECK(compare(b, a).relative_bias < 0.0);
}

TEST_CASE("noise that cancels in a block is no block difference") {
    const Image a(16, 8, 1, 1.0f);
    Image b = a;
    for (std::size_t i = 0; i < b.pixels.size(); ++i) b.pixels[i] += i % 2 == 0 ? 0.5f : -0.5f;
    const Difference d = compare(a, b);
    CHECK(d.max_block == Approx(0.0).margin(1e-12));
    CHECK(d.relative_bias == Approx(0.0).margin(1e-12));
    CHECK(d.rmse == Approx(0.5));
}

TEST_CASE("a pixel that is not finite in one picture only is an infinite difference") {
    const Image a(8, 8, 3, 0.5f);
    for (float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image b = a;
        b.at(3, 4)[1] = bad;
        const Difference d = compare(a, b);
        CHECK(std::isinf(d.rmse));
        CHECK(std::isinf(d.max_pixel));
        CHECK(std::isinf(d.max_block));
        CHECK(std::isinf(d.relative_bias));
        CHECK(d.max_pixel_place.x == 3);
        CHECK(d.max_pixel_place.y == 4);
        CHECK(std::isinf(compare(b, a).max_pixel));
    }
}

TEST_CASE("pictures of different shape cannot be compared") {
    CHECK_THROWS_AS(compare(Image(4, 4), Image(4, 5)), Error);
    CHECK_THROWS_AS(compare(Image(4, 4), Image(5, 4)), Error);
    CHECK_THROWS_AS(compare(Image(4, 4, 3), Image(4, 4, 1)), Error);
}
