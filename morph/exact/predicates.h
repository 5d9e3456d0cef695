#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>

namespace automorph {

/// A vertex of a map: a ray from the origin. A disk point (x, y) is (x, y, 1), a sphere point is itself; only
/// the direction counts.
using Ray = Eigen::Vector3d;

namespace detail {

struct Filtered {
    double value;        ///< det[a b c] in doubles
    double error_bound;  ///< |value - exact| is below this
};

/// det[a b c] = a . ((b - a) x (c - a)): with differences, small triangles lose no digits. Each of the three
/// sums of products of the expansion is rounded at most 8 times on the way, so the error is below 12 u times
/// the permanent, u = 2^-53 (compare [Shewchuk97] Sec. 4.3); underflow is covered by the additive term.
inline Filtered filtered_determinant(const Ray& a, const Ray& b, const Ray& c) {
    constexpr double kRelative = 6.0 * std::numeric_limits<double>::epsilon();
    constexpr double kUnderflow = 64.0 * std::numeric_limits<double>::min();
    const double dx = b.x() - a.x(), dy = b.y() - a.y(), dz = b.z() - a.z();
    const double ex = c.x() - a.x(), ey = c.y() - a.y(), ez = c.z() - a.z();
    if (dz == 0.0 && ez == 0.0) {  // on the disk, z = 1: the same bits with less work
        const double dxey = dx * ey, dyex = dy * ex;
        return {a.z() * (dxey - dyex),
                kRelative * (std::abs(a.z()) * (std::abs(dxey) + std::abs(dyex))) + kUnderflow};
    }
    const double dyez = dy * ez, dzey = dz * ey, dzex = dz * ex, dxez = dx * ez, dxey = dx * ey,
                 dyex = dy * ex;
    const double value = a.x() * (dyez - dzey) + a.y() * (dzex - dxez) + a.z() * (dxey - dyex);
    const double permanent = std::abs(a.x()) * (std::abs(dyez) + std::abs(dzey)) +
                             std::abs(a.y()) * (std::abs(dzex) + std::abs(dxez)) +
                             std::abs(a.z()) * (std::abs(dxey) + std::abs(dyex));
    return {value, kRelative * permanent + kUnderflow};
}

int exact_orientation(const Ray& a, const Ray& b, const Ray& c);

}  // namespace detail

/// Sign of det[a b c], exact on the given doubles: +1 if a, b, c turn counter-clockwise seen from outside
/// (on z = 1: the plane's orient2d), -1 if clockwise, 0 if they lie on one great circle (line).
inline int orientation(const Ray& a, const Ray& b, const Ray& c) {
    const detail::Filtered det = detail::filtered_determinant(a, b, c);
    if (det.value > det.error_bound) return 1;
    if (det.value < -det.error_bound) return -1;
    return detail::exact_orientation(a, b, c);
}

/// det[a b c] to within a few units in the last place of the exact value, however close to zero it is.
double determinant(const Ray& a, const Ray& b, const Ray& c);

}  // namespace automorph
