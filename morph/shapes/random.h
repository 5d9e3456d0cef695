#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace automorph {

/// Random numbers that are the same bits with every standard library (its distributions are not) and use no
/// function that is rounded differently somewhere.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// In [0, 1).
    double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

    /// Uniform in the unit ball of n dimensions (n <= 4).
    template <int n>
    Eigen::Matrix<double, n, 1> in_ball() {
        Eigen::Matrix<double, n, 1> x;
        do {
            for (int k = 0; k < n; ++k) x[k] = 2.0 * uniform() - 1.0;
        } while (x.squaredNorm() > 1.0);
        return x;
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace automorph
