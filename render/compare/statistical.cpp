#include "render/compare/statistical.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "render/compare/difference.h"
#include "render/compare/noise_tests.h"
#include "render/compare/pixel_noise.h"
#include "render/compare/surfaces.h"

namespace automorph::render {
namespace {

double even_change(const NoiseMap& noise, double limit) {
    double least = std::numeric_limits<double>::infinity();
    for (int c = 0; c < 3; ++c) {
        const BlockSums sums = sums_of(noise, {0, 0, noise.width(), noise.height(), c});
        if (sums.signal > 0.0) least = std::min(least, limit * sums.scale / sums.signal);
    }
    return least;
}

double local_change(const NoiseMap& noise, double limit) {
    std::vector<double> sigmas;
    for_each_window(noise.width(), noise.height(), kWindow, [&](Place window) {
        for (window.channel = 0; window.channel < 3; ++window.channel) {
            const double sigma = window_noise(noise, window).sigma;
            if (sigma > 0.0) sigmas.push_back(sigma);
        }
    });
    if (sigmas.empty()) return 0.0;
    const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
    std::nth_element(sigmas.begin(), middle, sigmas.end());
    return limit * *middle / (kWindow * kWindow);
}

double root_mean(const Image& variance) {
    double sum = 0.0;
    for (const float each : variance.pixels) sum += each;
    return std::sqrt(sum / static_cast<double>(variance.pixels.size()));
}

std::vector<NoiseTest> radiance_tests(const NoiseMap& noise) {
    std::vector<NoiseTest> tests;
    for (const int side : {kSmallBlock, kLargeBlock}) {
        if (noise.width() > side || noise.height() > side) tests.push_back(block_test(noise, side));
    }
    tests.push_back(whole_test(noise));
    tests.push_back(window_test(noise, 1));
    if (std::min(noise.width(), noise.height()) >= kWindow) tests.push_back(window_test(noise, kWindow));
    return tests;
}

/// Sets what both pictures have where the figures of the tests are largest.
void look_up(std::vector<NoiseTest>& tests, const Image& golden, const Image& found) {
    for (NoiseTest& test : tests) {
        test.result.golden = mean(golden, test.result.where);
        test.result.found = mean(found, test.result.where);
    }
}

std::vector<NoiseTest> surface_tests(const NoisyImage& golden, const NoisyImage& found) {
    const NormalNoise normals(golden, found);
    std::vector<NoiseTest> tests{normals.block_test(kSmallBlock), normals.window_test(1)};
    if (std::min(golden.image.width, golden.image.height) >= kWindow)
        tests.push_back(normals.window_test(kWindow));
    look_up(tests, golden.surfaces->shading_normal, found.surfaces->shading_normal);
    std::vector<NoiseTest> albedo{
        block_test(NoiseMap(noisy_albedo(golden), noisy_albedo(found)), kSmallBlock)};
    albedo.front().result.name = "albedo, " + albedo.front().result.name;
    look_up(albedo, golden.surfaces->albedo, found.surfaces->albedo);
    tests.push_back(albedo.front());
    return tests;
}

TestResult finite_test(const NoiseMap& noise) {
    TestResult test;
    test.name = "not finite";
    test.value = static_cast<double>(noise.not_finite());
    test.where = noise.not_finite_place();
    return test;
}

// Sets limit and chance of a test, and the severities of its figures.
void judge(NoiseTest& test, double rate, Image& severity) {
    TestResult& result = test.result;
    result.limit = limit_for(test.count, rate);
    result.chance = std::min(1.0, 2.0 * test.count * std::exp(-0.5 * result.value * result.value));
    const auto limit = static_cast<float>(result.limit);
    for (std::size_t i = 0; i < test.figures.pixels.size(); ++i) {
        const float share = test.figures.pixels[i] / limit;
        if (test.is_coarse && share <= 1.0f) continue;
        severity.pixels[i] = std::max(severity.pixels[i], share);
    }
}

}  // namespace

StatisticalComparison compare_statistical(const NoisyImage& golden, const NoisyImage& found,
                                          const StatisticalOptions& options) {
    const NoiseMap noise(golden, found);
    std::vector<NoiseTest> tests = radiance_tests(noise);
    look_up(tests, golden.image, found.image);
    const double windows = tests.back().count;
    const bool surfaces = golden.surfaces && found.surfaces;
    if (surfaces) {
        const std::vector<NoiseTest> more = surface_tests(golden, found);
        tests.insert(tests.end(), more.begin(), more.end());
    }
    StatisticalComparison comparison;
    comparison.severity = Image(noise.width(), noise.height(), 1);
    comparison.severity_unit = "limit";
    const double rate_of_each = options.false_alarm_rate / static_cast<double>(tests.size());
    for (NoiseTest& test : tests) {
        judge(test, rate_of_each, comparison.severity);
        comparison.tests.push_back(test.result);
    }
    if (surfaces) comparison.tests.push_back(depth_test(golden, found, comparison.severity));
    if (noise.not_finite() > 0) {
        TestResult test = finite_test(noise);
        test.golden = mean(golden.image, test.where);
        test.found = mean(found.image, test.where);
        comparison.tests.push_back(test);
    }
    comparison.sensitivity = {even_change(noise, limit_for(3.0, rate_of_each)),
                              local_change(noise, limit_for(windows, rate_of_each)),
                              root_mean(golden.variance), root_mean(found.variance)};
    return comparison;
}

}  // namespace automorph::render
