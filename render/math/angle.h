#pragma once

#include <Eigen/Core>
#include <cmath>

namespace automorph::render {

inline constexpr double kRadians = 3.14159265358979324 / 180.0;  ///< in a degree

/// The angle in [0, pi] whose sine and cosine are in the ratio `sine` : `cosine`, for sine >= 0; zero for 0,
/// 0. Relative error below 1e-9. Only operations that round alike on all machines are used, which std::atan2
/// is not one of: the C library has a variant for each kind of processor. Coefficientwise.
template <int Size>
Eigen::Array<double, Size, 1> angle_of(const Eigen::Array<double, Size, 1>& sine,
                                       const Eigen::Array<double, Size, 1>& cosine) {
    using Array = Eigen::Array<double, Size, 1>;
    const Array length = (sine * sine + cosine * cosine).sqrt();
    // Tangent of half the acute angle, then of an eighth: at most tan(pi / 16), where the series is short.
    Array t = sine / (length + cosine.abs());
    for (int i = 0; i < 2; ++i) t = t / (1.0 + (1.0 + t * t).sqrt());
    const Array s = t * t;
    const Array series =
        1.0 +
        s * (-1.0 / 3 + s * (1.0 / 5 + s * (-1.0 / 7 + s * (1.0 / 9 + s * (-1.0 / 11 + s * (1.0 / 13))))));
    const Array sharp = 8.0 * t * series;
    constexpr double kHalfTurn = 3.14159265358979324;
    return (length > 0.0).select((cosine < 0.0).select(kHalfTurn - sharp, sharp), 0.0);
}

/// The same of one angle.
inline double angle_of(double sine, double cosine) {
    using One = Eigen::Array<double, 1, 1>;
    return angle_of<1>(One(sine), One(cosine)).value();
}

struct SineCosine {
    double sine, cosine;
};

/// Sine and cosine of an angle in [-pi, pi], within 1e-11, with the same operations only.
inline SineCosine sine_and_cosine(double angle) {
    constexpr double kQuarterTurn = 1.57079632679489662;
    const double quarters = std::nearbyint(angle / kQuarterTurn);  // -2 ... 2
    const double x = angle - quarters * kQuarterTurn, s = x * x;   // |x| <= pi / 4
    const double sine =
        x * (1.0 + s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040 + s * (1.0 / 362880 - s / 39916800)))));
    const double cosine =
        1.0 + s * (-0.5 + s * (1.0 / 24 +
                               s * (-1.0 / 720 + s * (1.0 / 40320 + s * (-1.0 / 3628800 + s / 479001600)))));
    if (quarters == 0.0) return {sine, cosine};
    if (quarters == 1.0) return {cosine, -sine};
    if (quarters == -1.0) return {-cosine, sine};
    return {-sine, -cosine};
}

}  // namespace automorph::render
