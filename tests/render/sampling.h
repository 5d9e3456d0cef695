#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "render/math/vec.h"

/// What tests of samplers share.
namespace automorph::render {

constexpr double kTwoPi = 6.283185307179586;

/// The unit vector with this z, `azimuth` radians about the z-axis.
inline Vec3 direction(double z, double azimuth) {
    const double s = std::sqrt(std::max(0.0, 1.0 - z * z));
    return Vec3(static_cast<float>(s * std::cos(azimuth)), static_cast<float>(s * std::sin(azimuth)),
                static_cast<float>(z));
}

/// Uniform numbers in [0, 1), the same in each run.
class Numbers {
public:
    explicit Numbers(std::uint32_t seed) : random_(seed) {}
    float operator()() { return std::min(uniform_(random_), 0x0.ffffffp0f); }

private:
    std::mt19937 random_;
    std::uniform_real_distribution<float> uniform_;
};

/// Counts points of the unit square, rings by sectors, which are to fall into each cell equally often.
class EvenCells {
public:
    EvenCells(int rings, int sectors)
        : rings_(rings),
          sectors_(sectors),
          counts_(static_cast<std::size_t>(rings) * static_cast<std::size_t>(sectors), 0) {}

    /// @param share  in [0, 1]
    /// @param x, y   the direction whose angle chooses the sector
    void add(double share, double x, double y) {
        const int ring = std::min(rings_ - 1, static_cast<int>(share * rings_));
        const double turn = std::atan2(y, x) / kTwoPi + 0.5;
        const int sector = std::min(sectors_ - 1, static_cast<int>(turn * sectors_));
        ++counts_[static_cast<std::size_t>(ring * sectors_ + sector)];
        ++total_;
    }

    /// Chi-square's distance from its mean, in standard deviations.
    double deviation() const {
        const double expected = total_ / static_cast<double>(counts_.size());
        const double freedom = static_cast<double>(counts_.size()) - 1.0;
        double chi2 = 0.0;
        for (const int count : counts_) chi2 += (count - expected) * (count - expected) / expected;
        return (chi2 - freedom) / std::sqrt(2.0 * freedom);
    }

private:
    int rings_, sectors_;
    std::vector<int> counts_;
    double total_ = 0.0;
};

}  // namespace automorph::render
