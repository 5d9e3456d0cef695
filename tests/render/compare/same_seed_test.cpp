#include "render/compare/same_seed.h"

#include <cmath>
#include <limits>

#include "morph/mesh/errors.h"
#include "render/compare/exact.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::render;

TEST_CASE("exact: one bit of one value is enough, and its place is told") {
    const Image golden(20, 12, 3, 0.5f);
    CHECK(compare_exact(golden, golden).same());
    Image found = golden;
    found.at(18, 9)[2] = std::nextafter(0.5f, 1.0f);
    const Comparison comparison = compare_exact(golden, found);
    CHECK_FALSE(comparison.same());
    const TestResult& test = comparison.worst();
    CHECK(test.value == 1.0);
    CHECK(test.limit == 0.0);
    CHECK(test.where.x == 18);
    CHECK(test.where.y == 9);
    CHECK(test.where.channel == 2);
    CHECK(test.golden == 0.5);
    CHECK(test.found > 0.5);
    CHECK(*comparison.severity.at(18, 9) == 1.0f);
    CHECK(*comparison.severity.at(17, 9) == 0.0f);
}

TEST_CASE("exact: zeros of other signs differ, equal NaNs do not") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(compare_exact(Image(4, 4, 1, 0.0f), Image(4, 4, 1, -0.0f)).same());
    CHECK(compare_exact(Image(4, 4, 1, nan), Image(4, 4, 1, nan)).same());
    CHECK_FALSE(compare_exact(Image(4, 4, 1, nan), Image(4, 4, 1, 0.0f)).same());
    CHECK(*compare_exact(Image(4, 4, 1, nan), Image(4, 4, 1, 0.0f)).severity.at(3, 3) == 1.0f);
}

TEST_CASE("same seed: both limits hold to the last bit, each on its own") {
    const Image golden(20, 20, 3, 0.5f);
    SameSeedLimits limits;
    SECTION("as many outliers as accepted, and one more") {
        limits.rmse = 1.0;
        Image found = golden;
        found.at(3, 4)[0] += 0.25f;
        found.at(3, 4)[1] += 0.25f;  // the same pixel
        found.at(9, 1)[2] -= 0.125f;
        CHECK(compare_same_seed(golden, found, limits).same());
        found.at(19, 19)[1] += 0.125f;
        const Comparison comparison = compare_same_seed(golden, found, limits);
        CHECK_FALSE(comparison.same());
        CHECK(comparison.worst().name == "outliers");
        CHECK(comparison.worst().value == 3.0);
        CHECK(comparison.worst().where.x == 3);
        CHECK(comparison.worst().where.y == 4);
        CHECK(comparison.worst().found == 0.75);
        CHECK(*comparison.severity.at(3, 4) == Approx(2.5));
    }
    SECTION("an even change is seen by the root mean square, in the block where it is largest") {
        Image found = golden;
        for (float& each : found.pixels) each += 0.0005f;
        CHECK(compare_same_seed(golden, found, limits).same());
        for (float& each : found.pixels) each += 0.001f;
        for (int y = 8; y < 16; ++y) {
            for (int x = 16; x < 20; ++x) found.at(x, y)[1] += 0.001f;
        }
        const Comparison comparison = compare_same_seed(golden, found, limits);
        CHECK_FALSE(comparison.same());
        CHECK(comparison.worst().name == "rmse");
        CHECK(comparison.worst().where.x == 16);
        CHECK(comparison.worst().where.y == 8);
        CHECK(comparison.worst().where.width == 4);
        CHECK(comparison.worst().where.channel == 1);
        CHECK(comparison.worst().found == Approx(0.5025));
    }
    SECTION("NaN in one picture only is a difference") {
        limits.outliers = 10;
        Image found = golden;
        found.at(2, 2)[0] = std::numeric_limits<float>::quiet_NaN();
        CHECK_FALSE(compare_same_seed(golden, found, limits).same());
        CHECK_FALSE(compare_same_seed(found, golden, limits).same());
        CHECK(compare_same_seed(found, found, limits).same());
    }
}

TEST_CASE("pictures of other sizes or channels are refused by every way of comparing") {
    CHECK_THROWS_AS(compare_exact(Image(4, 4), Image(5, 4)), Error);
    CHECK_THROWS_AS(compare_exact(Image(4, 4), Image(4, 4, 1)), Error);
    CHECK_THROWS_AS(compare_same_seed(Image(4, 4), Image(4, 5)), Error);
}
