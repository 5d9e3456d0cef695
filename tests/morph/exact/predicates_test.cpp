#include "morph/exact/predicates.h"

#include <cmath>
#include <limits>
#include <random>

#include "tests/catch.h"

using automorph::determinant;
using automorph::orientation;
using automorph::Ray;

namespace {

double uniform(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53 * 2.0 - 1.0;
}

Ray random_ray(std::mt19937_64& random) {
    return {uniform(random), uniform(random), uniform(random)};
}

}  // namespace

TEST_CASE("three rays that turn counter-clockwise seen from outside have orientation +1") {
    CHECK(orientation({0, 0, 1}, {1, 0, 1}, {0, 1, 1}) == 1);
    CHECK(orientation({0, 0, 1}, {0, 1, 1}, {1, 0, 1}) == -1);
    CHECK(orientation({1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == 1);
}

TEST_CASE("orientation is indifferent to the length of rays and antisymmetric under swaps") {
    std::mt19937_64 random(1);
    for (int i = 0; i < 2000; ++i) {
        const Ray a = random_ray(random), b = random_ray(random), c = random_ray(random);
        const int s = orientation(a, b, c);
        CHECK(orientation(b, c, a) == s);
        CHECK(orientation(b, a, c) == -s);
        CHECK(orientation(4.0 * a, 0.125 * b, c) == s);
    }
}

TEST_CASE("collinear points of the plane have orientation 0, and one ulp off has not") {
    // Multiples of 2^-30 add and multiply without rounding, so the point is exactly on the line.
    std::mt19937_64 random(2);
    const double unit = 0x1p-30;
    for (int i = 0; i < 2000; ++i) {
        const auto integer = [&] { return static_cast<double>(random() % 1024); };
        const Ray a(integer() * unit, integer() * unit, 1), d(integer() * unit, (1 + integer()) * unit, 0);
        const Ray b = a + 3 * d, c = a + 7 * d;
        REQUIRE(orientation(a, b, c) == 0);
        const Ray right(std::nextafter(c.x(), 1.0), c.y(), 1), left(std::nextafter(c.x(), -1.0), c.y(), 1);
        CHECK(orientation(a, b, right) == -1);
        CHECK(orientation(a, b, left) == 1);
    }
}

TEST_CASE("a ray on the great circle of two others has orientation 0") {
    CHECK(orientation({1, 2, 3}, {4, 5, 6}, {5, 7, 9}) == 0);
    CHECK(orientation({1, 2, 3}, {4, 5, 6}, {-3, -3, -3}) == 0);
}

TEST_CASE("the determinant keeps its relative accuracy near zero") {
    // Rows (1, 1 + e, 1), ... chosen so that the exact determinant is e * e with e = 2^-40: plain doubles
    // give 0 or noise.
    const double e = 0x1p-40;
    const Ray a(1, 1, 1), b(1, 1 + e, 1), c(1, 1, 1 + e);
    CHECK(determinant(a, b, c) == Approx(e * e).epsilon(1e-9));
    CHECK(determinant(a, c, b) == Approx(-e * e).epsilon(1e-9));
    CHECK(determinant(a, b, a) == 0.0);
    CHECK(determinant({2, 0, 0}, {0, 3, 0}, {0, 0, 4}) == Approx(24.0));
}

TEST_CASE("sign of the determinant and orientation agree on nearly flat triples") {
    std::mt19937_64 random(3);
    for (int i = 0; i < 3000; ++i) {
        const Ray a = random_ray(random), b = random_ray(random);
        const double s = uniform(random), t = uniform(random);
        const Ray c = s * a + t * b;  // rounded: flat but for the last bits
        const double value = determinant(a, b, c);
        CHECK((value > 0) - (value < 0) == orientation(a, b, c));
    }
}
