// The statistical comparison on made-up samples, whose distribution is known.
#include "render/compare/statistical.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/compare/pixel_noise.h"
#include "tests/catch.h"
#include "tests/render/compare/test_named.h"

using namespace automorph;
using namespace automorph::render;

namespace {

/// One sample of one channel of a pixel.
using Sample = std::function<float(std::mt19937&, int x, int y, int channel)>;

/// A picture of independent samples.
NoisyImage sampled(int width, int height, int spp, unsigned seed, const Sample& sample) {
    std::mt19937 random(seed);
    NoisyImage picture{Image(width, height), Image(width, height),
                       Image(width, height, 1, static_cast<float>(spp))};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0, squares = 0.0;
                for (int i = 0; i < spp; ++i) {
                    const double each = sample(random, x, y, c);
                    sum += each;
                    squares += each * each;
                }
                const double mean = sum / spp;
                picture.image.at(x, y)[c] = static_cast<float>(mean);
                picture.variance.at(x, y)[c] =
                    static_cast<float>(std::max(0.0, (squares / spp - mean * mean) / (spp - 1)));
            }
        }
    }
    return picture;
}

/// Radiance whose logarithm is normal: sometimes very bright.
float log_normal(std::mt19937& random, double spread) {
    return static_cast<float>(std::exp(std::normal_distribution<double>(0.0, spread)(random)));
}

float even(std::mt19937& random) {
    return std::uniform_real_distribution<float>(0.5f, 1.5f)(random);
}

NoisyImage even_picture(int size, int spp, unsigned seed, float factor = 1.0f) {
    return sampled(size, size, spp, seed,
                   [=](std::mt19937& random, int, int, int) { return factor * even(random); });
}

}  // namespace

TEST_CASE("noise of any distribution stays below the bound that the limits are made of") {
    // Per distribution, the share of windows and blocks whose figure exceeds x; allowed are 2 exp(-x^2 / 2).
    struct Case {
        const char* name;
        int spp;
        Sample sample;
    };
    const std::vector<Case> cases{
        {"even, few samples", 2, [](std::mt19937& r, int, int, int) { return even(r); }},
        {"even", 16, [](std::mt19937& r, int, int, int) { return even(r); }},
        {"one sample in 50 is bright", 16,
         [](std::mt19937& r, int, int, int) { return std::bernoulli_distribution(0.02)(r) ? 1.0f : 0.0f; }},
        {"one sample in 1000 is a firefly", 16,
         [](std::mt19937& r, int, int, int) {
             return even(r) + (std::bernoulli_distribution(0.001)(r) ? 1000.0f : 0.0f);
         }},
        {"log-normal", 16, [](std::mt19937& r, int, int, int) { return log_normal(r, 2.5); }},
        {"Pareto without a variance", 16, [](std::mt19937& r, int, int, int) {
             return std::pow(std::uniform_real_distribution<float>(1e-6f, 1.0f)(r), -1.0f / 1.5f);
         }}};
    for (const Case& each : cases) {
        constexpr int kSize = 128;
        const NoiseMap noise(sampled(kSize, kSize, each.spp, 1, each.sample),
                             sampled(kSize, kSize, each.spp, 2, each.sample));
        for (const int side : {1, 3}) {
            constexpr std::array<double, 4> kFigures{1.0, 2.0, 3.0, 4.0};
            std::array<double, 4> above{};
            double windows = 0.0;
            for (int y = 0; y + side <= kSize; y += side) {
                for (int x = 0; x + side <= kSize; x += side) {
                    for (int c = 0; c < 3; ++c) {
                        double difference = 0.0, variance = 0.0;
                        for (int j = y; j < y + side; ++j) {
                            for (int i = x; i < x + side; ++i) {
                                difference += noise.at(i, j, c).difference;
                                variance += std::pow(noise.at(i, j, c).sigma, 2.0);
                            }
                        }
                        windows += 1.0;
                        const double figure =
                            variance > 0.0 ? std::abs(difference) / std::sqrt(variance) : 0.0;
                        for (std::size_t k = 0; k < kFigures.size(); ++k)
                            above[k] += figure > kFigures[k] ? 1.0 : 0.0;
                    }
                }
            }
            for (std::size_t k = 0; k < kFigures.size(); ++k) {
                INFO(each.name << ", window " << side << ", x " << kFigures[k]);
                const double allowed = 2.0 * std::exp(-0.5 * kFigures[k] * kFigures[k]);
                CHECK(above[k] / windows <= allowed + 3.0 * std::sqrt(allowed / windows));
            }
        }
    }
}

TEST_CASE("noise of any distribution is rejected no more often than stated") {
    // A rate so high that 200 pairs tell: were the limits too low, more than 20 + 3 standard deviations would
    // fail.
    constexpr double kRate = 0.1;
    constexpr int kPairs = 200;
    const std::array<Sample, 3> samples{
        [](std::mt19937& r, int, int, int) { return even(r); },
        [](std::mt19937& r, int, int, int) { return log_normal(r, 2.0); },
        [](std::mt19937& r, int, int, int) { return std::bernoulli_distribution(0.05)(r) ? 20.0f : 0.1f; }};
    for (std::size_t k = 0; k < samples.size(); ++k) {
        int rejected = 0;
        for (int pair = 0; pair < kPairs; ++pair) {
            const auto seed = static_cast<unsigned>(1000 + 2 * pair);
            rejected += !compare_statistical(sampled(24, 24, 8, seed, samples[k]),
                                             sampled(24, 24, 8, seed + 1, samples[k]), {kRate})
                             .same();
        }
        INFO("distribution " << k << ": " << rejected << " of " << kPairs);
        CHECK(rejected <= 32);
    }
}

TEST_CASE("unequal sample counts do not raise false alarms, whatever is rare") {
    const Sample rare = [](std::mt19937& r, int, int, int) {
        return std::bernoulli_distribution(0.004)(r) ? 50.0f : 0.1f;
    };
    for (unsigned seed = 0; seed < 10; ++seed) {
        const NoisyImage converged = sampled(32, 32, 512, 2 * seed, rare),
                         noisy = sampled(32, 32, 16, 2 * seed + 1, rare);
        for (const auto& [golden, found] : {std::pair{&converged, &noisy}, std::pair{&noisy, &converged}}) {
            const StatisticalComparison comparison = compare_statistical(*golden, *found);
            INFO("seed " << seed << ": " << comparison.worst().name << ' ' << comparison.worst().value);
            CHECK(comparison.same());
        }
    }
}

TEST_CASE("an even change is found as soon as the stated sensitivity says") {
    const NoisyImage golden = even_picture(64, 16, 1);
    const double visible = compare_statistical(golden, even_picture(64, 16, 2)).sensitivity.even_change;
    // 4096 pixels, each with a standard error of 0.289 / 4 and a difference with sqrt 2 of that.
    const double limit = std::sqrt(2.0 * std::log(2.0 * 3 / (0.01 / 5)));
    CHECK(visible == Approx(limit * 0.2887 / 4 * std::sqrt(2.0) / 64).epsilon(0.05));
    int caught = 0;
    for (unsigned seed = 10; seed < 20; ++seed) {
        const auto more = static_cast<float>(1.0 + 1.5 * visible);
        caught += !compare_statistical(golden, even_picture(64, 16, seed, more)).same();
    }
    CHECK(caught == 10);  // at 1.5 times, 2 standard deviations above the limit
}

TEST_CASE("a change is told with its place, size and chance") {
    const NoisyImage golden = even_picture(64, 16, 1);
    SECTION("in a block") {
        const NoisyImage found = sampled(64, 64, 16, 2, [](std::mt19937& r, int x, int y, int c) {
            return even(r) * (x >= 16 && x < 24 && y >= 40 && y < 48 && c == 2 ? 1.1f : 1.0f);
        });
        const StatisticalComparison comparison = compare_statistical(golden, found);
        CHECK_FALSE(comparison.same());
        const TestResult& test = test_named(comparison, "blocks 8 x 8");
        CHECK_FALSE(test.passed());
        CHECK(test.where.x == 16);
        CHECK(test.where.y == 40);
        CHECK(test.where.width == 8);
        CHECK(test.where.channel == 2);
        CHECK(test.found / test.golden == Approx(1.1).margin(0.04));
        CHECK(test.chance.value() < 0.002);
        CHECK(*comparison.severity.at(20, 44) > 1.0f);
        CHECK(*comparison.severity.at(5, 5) < 1.0f);
    }
    SECTION("in one pixel of a noise-free surrounding") {
        const NoisyImage still = sampled(64, 64, 64, 1, [](auto&, int, int, int) { return 0.5f; });
        NoisyImage found = still;
        CHECK(compare_statistical(still, found).same());
        found.image.at(7, 9)[1] = 0.51f;
        const StatisticalComparison comparison = compare_statistical(still, found);
        CHECK_FALSE(comparison.same());
        const TestResult& test = test_named(comparison, "single pixels");
        CHECK_FALSE(test.passed());
        CHECK(test.where.x == 7);
        CHECK(test.where.y == 9);
        CHECK(test.where.channel == 1);
        CHECK(test.value == Approx(std::sqrt(127.0)));  // the most that 64 + 64 samples can say
    }
}

TEST_CASE("a firefly in one of the pictures is no difference, a bright pixel is") {
    constexpr double kSamples = 64;
    const NoisyImage golden = even_picture(32, 64, 1);
    NoisyImage found = even_picture(32, 64, 2);
    const auto set = [&](double mean, double variance) {
        found.image.at(12, 12)[0] = static_cast<float>(mean);
        found.variance.at(12, 12)[0] = static_cast<float>(variance);
    };
    const double one = 1000.0 / kSamples;  // one sample of 1000, the others 0 more than usual
    set(1.0 + one, (1000.0 * one - one * one) / (kSamples - 1));
    CHECK(compare_statistical(golden, found).same());
    set(1.5, 1.0 / 12 / kSamples);  // all samples brighter
    CHECK_FALSE(compare_statistical(golden, found).same());
}

TEST_CASE("rounding is no difference, even where there is no noise and everywhere of one sign") {
    const NoisyImage golden = sampled(40, 40, 16, 1, [](auto&, int, int, int) { return 0.93f; });
    NoisyImage found = golden;
    for (float& each : found.image.pixels) each *= 1.000005f;
    CHECK(compare_statistical(golden, found).same());
    for (float& each : found.image.pixels) each *= 1.00002f;
    CHECK_FALSE(compare_statistical(golden, found).same());
}

TEST_CASE("a value that is not finite in one picture only is a difference") {
    const NoisyImage golden = even_picture(16, 8, 1);
    NoisyImage found = even_picture(16, 8, 2);
    found.image.at(3, 5)[1] = std::numeric_limits<float>::quiet_NaN();
    const StatisticalComparison comparison = compare_statistical(golden, found);
    CHECK_FALSE(comparison.same());
    CHECK(comparison.worst().name == "not finite");
    CHECK(comparison.worst().where.x == 3);
    CHECK(comparison.worst().where.y == 5);
    CHECK(compare_statistical(found, found).same());
}

TEST_CASE("pictures without noise layers that make sense are refused") {
    const NoisyImage golden = even_picture(16, 8, 1);
    NoisyImage few = golden, negative = golden, unknown = golden;
    *few.samples.at(4, 2) = 1.0f;
    CHECK_THROWS_AS(compare_statistical(golden, few), Error);
    CHECK_THROWS_AS(compare_statistical(few, golden), Error);
    negative.variance.at(4, 2)[0] = -1.0f;
    CHECK_THROWS_AS(compare_statistical(golden, negative), Error);
    unknown.variance.at(4, 2)[0] = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS(compare_statistical(golden, unknown), Error);
    CHECK_THROWS_AS(compare_statistical(golden, even_picture(17, 8, 1)), Error);
}
