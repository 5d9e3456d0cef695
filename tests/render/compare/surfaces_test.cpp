// Normals, albedo and depth in the statistical comparison, on made-up surfaces whose distribution is known.
#include "render/compare/surfaces.h"

#include <cmath>
#include <limits>
#include <random>

#include "tests/catch.h"
#include "tests/render/compare/test_named.h"

using namespace automorph::render;

namespace {

constexpr int kSize = 24, kSpp = 16;

/// Pixels with an edge somewhere in them: a share of the samples, by chance, sees a facet that is tilted by
/// `tilt` (radians) and darker. Radiance has the same even noise everywhere.
NoisyImage edges(unsigned seed, double tilt) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Image mean(kSize, kSize), variance(kSize, kSize);
    Surfaces surfaces{Image(kSize, kSize), Image(kSize, kSize), Image(kSize, kSize, 1, 3.0f)};
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const double share = std::fmod(0.37 * x + 0.61 * y, 1.0);
            double radiance = 0.0, squares = 0.0, tilted = 0.0;
            for (int i = 0; i < kSpp; ++i) {
                const double sample = 0.5 + unit(random);
                radiance += sample / kSpp;
                squares += sample * sample / kSpp;
                tilted += unit(random) < share ? 1.0 / kSpp : 0.0;
            }
            for (int c = 0; c < 3; ++c) {
                mean.at(x, y)[c] = static_cast<float>(radiance);
                variance.at(x, y)[c] = static_cast<float>((squares - radiance * radiance) / (kSpp - 1));
                surfaces.albedo.at(x, y)[c] = static_cast<float>(0.7 - 0.3 * tilted);
            }
            surfaces.shading_normal.at(x, y)[0] = static_cast<float>(tilted * std::sin(tilt));
            surfaces.shading_normal.at(x, y)[2] = static_cast<float>(1.0 - tilted + tilted * std::cos(tilt));
        }
    }
    return {mean, variance, Image(kSize, kSize, 1, static_cast<float>(kSpp)), surfaces};
}

}  // namespace

TEST_CASE("noise of surfaces is rejected no more often than stated") {
    constexpr int kPairs = 400;
    constexpr double kRate = 0.1;
    for (const double tilt : {0.02, 0.5, 3.0}) {
        int rejected = 0;
        for (unsigned pair = 0; pair < kPairs; ++pair)
            rejected +=
                !compare_statistical(edges(2 * pair, tilt), edges(2 * pair + 1, tilt), {kRate}).same();
        INFO("tilt " << tilt << ": " << rejected << " of " << kPairs);
        CHECK(rejected <= kRate * kPairs);
    }
}

TEST_CASE("a facet that is turned in few pixels is found by its normal") {
    const NoisyImage golden = edges(1, 0.1);
    NoisyImage found = edges(2, 0.1);
    for (int x = 10; x < 13; ++x) {
        float* normal = found.surfaces->shading_normal.at(x, 7);
        normal[1] += 0.3f;
        const float length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
        for (int c = 0; c < 3; ++c) normal[c] /= length;
    }
    const StatisticalComparison comparison = compare_statistical(golden, found);
    const TestResult& test = test_named(comparison, "normal, windows 3 x 3");
    CHECK_FALSE(test.passed());
    CHECK(test.channels.at(static_cast<std::size_t>(test.where.channel)) == "y");
    CHECK(std::abs(test.where.x - 10) <= 1);
    CHECK(std::abs(test.where.y - 6) <= 1);
    CHECK(test.found - test.golden == Approx(0.1).epsilon(0.2));
    // Without the layers in one of the pictures nothing is seen: the radiance is the same.
    found.surfaces.reset();
    CHECK(compare_statistical(golden, found).same());
}

TEST_CASE("an albedo that is one per cent brighter is found in a block") {
    const NoisyImage golden = edges(1, 0.1);
    NoisyImage found = edges(2, 0.1);
    for (int y = 8; y < 16; ++y) {
        for (int x = 8; x < 16; ++x) {
            for (int c = 0; c < 3; ++c)
                found.surfaces->albedo.at(x, y)[c] = golden.surfaces->albedo.at(x, y)[c] * 1.01f;
        }
    }
    const TestResult& test = test_named(compare_statistical(golden, found), "albedo, blocks 8 x 8");
    CHECK_FALSE(test.passed());
    CHECK(test.where.x == 8);
    CHECK(test.where.y == 8);
    CHECK(test.found == Approx(1.01 * test.golden));
}

TEST_CASE("pixels that look at another depth are counted, a stray one or two are let pass") {
    const NoisyImage golden = edges(1, 0.1);
    NoisyImage found = edges(2, 0.1);
    for (int x = 0; x < kSize; ++x) *found.surfaces->depth.at(x, 3) *= 1.00001f;  // rounding
    *found.surfaces->depth.at(5, 6) = std::numeric_limits<float>::infinity();
    *found.surfaces->depth.at(6, 6) = 2.9f;
    CHECK(test_named(compare_statistical(golden, found), "other depth, pixels").value == 2.0);
    CHECK(compare_statistical(golden, found).same());
    *found.surfaces->depth.at(7, 6) = 3.001f;
    const StatisticalComparison comparison = compare_statistical(golden, found);
    CHECK_FALSE(comparison.same());
    const TestResult& test = test_named(comparison, "other depth, pixels");
    CHECK_FALSE(test.passed());
    CHECK((test.where.x == 5 && test.where.y == 6));
    CHECK(test.golden == Approx(3.0));
    CHECK(*comparison.severity.at(7, 6) >= 2.0f);
}
