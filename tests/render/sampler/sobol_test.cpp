#include "render/sampler/sobol.h"

#include <cmath>
#include <set>
#include <vector>

#include "tests/catch.h"

using namespace automorph::render;

namespace {

// Binomial coefficients modulo 2 (Lucas): the generator matrix of Sobol's second dimension.
std::uint32_t second_dimension(std::uint32_t index) {
    std::uint32_t result = 0;
    for (unsigned column = 0; column < 32; ++column) {
        if ((index >> column & 1u) == 0) continue;
        for (unsigned row = 0; row < 32; ++row) {
            if ((row & ~column) == 0) result ^= 1u << (31 - row);
        }
    }
    return result;
}

// Whether each of the boxes of 2^-a by 2^-b holds exactly one of 2^(a+b) points.
bool is_net(const std::vector<Sample2>& points, unsigned a, unsigned b) {
    std::set<std::pair<unsigned, unsigned>> boxes;
    for (const Sample2& p : points) {
        boxes.emplace(static_cast<unsigned>(std::ldexp(p.u, static_cast<int>(a))),
                      static_cast<unsigned>(std::ldexp(p.v, static_cast<int>(b))));
    }
    return boxes.size() == points.size();
}

}  // namespace

TEST_CASE("the second dimension is Sobol's, computed by its generator matrix") {
    for (std::uint32_t i = 0; i < 3000; ++i)
        CHECK(reverse_bits(sobol_second_reversed(i)) == second_dimension(i));
    for (std::uint32_t i = 1; i != 0; i *= 2) {
        CHECK(reverse_bits(sobol_second_reversed(i)) == second_dimension(i));
        CHECK(reverse_bits(sobol_second_reversed(~i)) == second_dimension(~i));
    }
}

TEST_CASE("Owen scrambling flips each bit by the bits above it only, and is a bijection") {
    for (std::uint32_t seed : {0u, 1u, 0x12345678u, 0xffffffffu}) {
        std::set<std::uint32_t> images;
        for (std::uint32_t x = 0; x < 1024; ++x) {
            const std::uint32_t y = owen_scramble_reversed(x, seed);
            images.insert(y & 1023u);
            for (unsigned bit = 0; bit < 10; ++bit) {
                // Inputs that agree below `bit` (reversed: above) and at it agree in the output up to it.
                const std::uint32_t mask = (2u << bit) - 1u;
                CHECK(((owen_scramble_reversed(x ^ 0xabcd0400u, seed) ^ y) & mask & 1023u) == 0);
                CHECK(((owen_scramble_reversed(x ^ (1u << bit), seed) ^ y) & mask) == 1u << bit);
            }
        }
        CHECK(images.size() == 1024);
    }
}

TEST_CASE("every aligned block of 2^m samples of every pair is a (0, m, 2)-net") {
    for (std::uint32_t pixel = 0; pixel < 12; ++pixel) {
        const PixelSampler random(pixel % 3, pixel % 2, pixel, 7 * pixel);
        for (std::uint32_t pair : {0u, 1u, 2u, 17u}) {
            for (unsigned m : {0u, 1u, 4u, 7u, 10u}) {
                for (std::uint32_t block : {0u, 1u, 5u}) {
                    std::vector<Sample2> points;
                    for (std::uint32_t i = 0; i < 1u << m; ++i)
                        points.push_back(random((block << m) + i, pair));
                    // a = 0 and a = m are the stratifications of the two single dimensions.
                    for (unsigned a = 0; a <= m; ++a) CHECK(is_net(points, a, m - a));
                }
            }
        }
    }
}

TEST_CASE("a batch has the numbers of its samples, to the bit") {
    PixelSampler::Batch batch;
    for (std::uint32_t index : {0u, 16u, 48u, 4096u, 0xfffffff0u}) {
        for (std::uint32_t pair = 0; pair < 5; ++pair) {
            const PixelSampler random(7, 1, 100, 50);
            random(index, pair, batch);
            for (std::size_t i = 0; i < PixelSampler::kBatch; ++i) {
                const Sample2 single = random(index + static_cast<std::uint32_t>(i), pair);
                CHECK(batch.u[i] == single.u);
                CHECK(batch.v[i] == single.v);
            }
        }
    }
}

TEST_CASE("numbers lie in [0, 1), even for the largest bits") {
    CHECK(to_unit(0) == 0.0f);
    CHECK(to_unit(0xffffffffu) < 1.0f);
}

TEST_CASE("each number is uniform over pixels, and pairs, frames and seeds are uncorrelated") {
    constexpr int kPixels = 1 << 14;
    constexpr int kBins = 64;
    std::vector<int> histogram(kBins, 0);
    // Products of centred numbers: u with v, with the next pair, frame, seed, pixel and sample.
    std::vector<double> products(6, 0.0);
    for (int i = 0; i < kPixels; ++i) {
        const auto x = static_cast<std::uint32_t>(i % 128), y = static_cast<std::uint32_t>(i / 128);
        const Sample2 here = PixelSampler(3, 5, x, y)(9, 2);
        const double u = here.u - 0.5;
        ++histogram[static_cast<std::size_t>(here.u * kBins)];
        const std::vector<double> others{here.v,
                                         PixelSampler(3, 5, x, y)(9, 3).u,
                                         PixelSampler(3, 6, x, y)(9, 2).u,
                                         PixelSampler(4, 5, x, y)(9, 2).u,
                                         PixelSampler(3, 5, x + 1, y)(9, 2).u,
                                         PixelSampler(3, 5, y, x + 200)(9, 2).u};
        for (std::size_t k = 0; k < others.size(); ++k) products[k] += u * (others[k] - 0.5);
    }
    double chi2 = 0.0;
    for (int count : histogram) {
        const double expected = static_cast<double>(kPixels) / kBins;
        chi2 += (count - expected) * (count - expected) / expected;
    }
    CHECK(chi2 < 114.0);  // 63 degrees of freedom, probability 1e-4
    const double sigma = std::sqrt(static_cast<double>(kPixels)) / 12.0;
    for (double product : products) CHECK(std::abs(product) < 4.0 * sigma);
}

TEST_CASE("means converge faster than those of independent numbers") {
    // The mean of u^2 v is 1/6, its variance 1/15 - 1/36 per independent sample.
    constexpr int kPixels = 256;
    const auto rms_error = [](std::uint32_t samples) {
        double squares = 0.0;
        for (std::uint32_t pixel = 0; pixel < kPixels; ++pixel) {
            const PixelSampler random(0, 0, pixel, 0);
            double sum = 0.0;
            for (std::uint32_t i = 0; i < samples; ++i) {
                const Sample2 s = random(i, 4);
                sum += static_cast<double>(s.u) * s.u * s.v;
            }
            const double error = sum / samples - 1.0 / 6.0;
            squares += error * error;
        }
        return std::sqrt(squares / kPixels);
    };
    const double independent = std::sqrt(1.0 / 15 - 1.0 / 36);
    CHECK(rms_error(1) == Approx(independent).epsilon(0.15));
    CHECK(rms_error(64) < independent / 8 / 5);
    // Owen-scrambled nets reach N^-1.5 on smooth functions: 16 times the samples, 64 times less error.
    CHECK(rms_error(1024) < rms_error(64) / 30);
}
