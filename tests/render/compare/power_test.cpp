// The statistical comparison on rendered pictures: how often it is wrong, and what it sees.
#include <cmath>
#include <cstdio>
#include <vector>

#include "render/compare/pixel_noise.h"
#include "tests/catch.h"
#include "tests/render/compare/power_scenes.h"

using namespace automorph::render;
using power::Body;
using power::Change;
using power::kBodies;
using power::picture;

namespace {

/// Variance of the sums of 8 x 8 pixels and correlation of neighbours, as measured in differences of seeds.
struct Covariance {
    double squares = 0.0, variances = 0.0;  // of blocks, in units of the sum of the pixels' stored variances
    double products = 0.0, own_squares = 0.0;  // of neighbouring pixels in standard errors

    void add(const NoiseMap& noise) {
        constexpr int kBlock = 8;
        for (int y = 0; y + kBlock <= noise.height(); y += kBlock) {
            for (int x = 0; x + kBlock <= noise.width(); x += kBlock) add_block(noise, x, y);
        }
        for (int y = 0; y < noise.height(); ++y) {
            for (int x = 0; x + 1 < noise.width(); ++x) {
                const PixelNoise &a = noise.at(x, y, 1), &b = noise.at(x + 1, y, 1);
                if (!(a.sigma > 0.0 && b.sigma > 0.0)) continue;
                products += a.difference / a.sigma * b.difference / b.sigma;
                own_squares +=
                    0.5 * (std::pow(a.difference / a.sigma, 2) + std::pow(b.difference / b.sigma, 2));
            }
        }
    }
    double block_ratio() const { return squares / variances; }
    double neighbours() const { return products / own_squares; }

private:
    void add_block(const NoiseMap& noise, int x0, int y0) {
        double sum = 0.0, variance = 0.0;
        for (int y = y0; y < y0 + 8; ++y) {
            for (int x = x0; x < x0 + 8; ++x) {
                sum += noise.at(x, y, 1).difference;
                variance += std::pow(noise.at(x, y, 1).sigma, 2);
            }
        }
        if (!(variance > 0.0)) return;
        squares += sum * sum / variance;
        variances += 1.0;
    }
};

}  // namespace

TEST_CASE("of 102 pairs that differ in nothing but the seed, the stated share is rejected at most",
          "[sweep]") {
    constexpr int kPairs = 34;  // per scene
    constexpr double kRate = 0.01;
    int rejected = 0;
    for (const Body body : kBodies) {
        power::Settings settings{48, 16, 100};
        if (body == Body::Metal) settings.filter = Filter::Box;
        Covariance covariance;
        NoisyImage before = picture(body, Change::None, settings);
        for (int pair = 0; pair < kPairs; ++pair) {
            ++settings.seed;
            NoisyImage next = picture(body, Change::None, settings);
            const StatisticalComparison comparison = compare_statistical(before, next, {kRate});
            if (!comparison.same()) {
                ++rejected;
                UNSCOPED_INFO(power::name(body)
                              << ", seed " << settings.seed << ": " << comparison.worst().name);
            }
            covariance.add(NoiseMap(before, next));
            before = std::move(next);
        }
        // Stratification makes blocks quieter than independent samples would, and no filter binds neighbours
        // to each other. 34 x 2208 neighbours: the standard deviation is below 0.004.
        INFO(power::name(body) << ": block variance " << covariance.block_ratio() << ", neighbours "
                               << covariance.neighbours());
        CHECK(covariance.block_ratio() < 1.0);
        CHECK(std::abs(covariance.neighbours()) < 0.02);
    }
    CHECK(rejected <= 1);  // 1 % of 102
}

TEST_CASE("adaptive sampling raises no false alarms either") {
    for (const Body body : kBodies) {
        power::Settings settings{48, 32, 300};
        settings.adaptive_error = 0.05;
        const NoisyImage golden = picture(body, Change::None, settings);
        settings.seed = 301;
        const NoisyImage found = picture(body, Change::None, settings);
        REQUIRE(golden.samples.pixels != found.samples.pixels);
        CHECK(compare_statistical(golden, found).same());
    }
}

TEST_CASE("deliberate changes are found across seeds", "[sweep]") {
    for (const Body body : kBodies) {
        const NoisyImage golden = picture(body, Change::None, {96, 32, 1});
        for (const Change change : power::kChanges) {
            const StatisticalComparison comparison =
                compare_statistical(golden, picture(body, change, {96, 32, 2}));
            INFO(power::name(body) << ", " << power::name(change) << ": " << comparison.worst().name << ' '
                                   << comparison.worst().value << " of " << comparison.worst().limit);
            CHECK_FALSE(comparison.same());
        }
    }
}

TEST_CASE("shading is compared more sharply where the seed is the same") {
    const auto share = [](const TestResult& test) { return test.value / test.limit; };
    const NoisyImage golden = picture(Body::Clay, Change::None, {48, 8, 1});
    CHECK(compare_statistical(golden, golden).same());
    for (const Change change : {Change::Light, Change::Albedo}) {
        INFO(power::name(change));
        const auto same_seed = compare_statistical(golden, picture(Body::Clay, change, {48, 8, 1}));
        const auto other_seed = compare_statistical(golden, picture(Body::Clay, change, {48, 8, 2}));
        CHECK_FALSE(same_seed.same());
        CHECK(share(same_seed.worst()) > 2.0 * share(other_seed.worst()));
    }
}

// The table in render/compare/README.md: build/release/tests/compare_test "[.power]"
TEST_CASE("how many of 10 seeds show each change, at three sizes", "[.power][sweep]") {
    for (const power::Settings settings : {power::Settings{48, 16}, {64, 32}, {96, 64}}) {
        std::printf("%d x %d, %d samples\n", settings.size, settings.size, settings.spp);
        for (const Change change : power::kChanges) {
            std::printf("%-30s", power::name(change));
            for (const Body body : kBodies) {
                power::Settings each = settings;
                const NoisyImage golden = picture(body, Change::None, each);
                int caught = 0;
                for (each.seed = 11; each.seed <= 20; ++each.seed)
                    caught += !compare_statistical(golden, picture(body, change, each)).same();
                std::printf("  %s %2d", power::name(body), caught);
            }
            std::printf("\n");
        }
    }
}
