#include "morph/exact/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/MP_Float.h>

#include <cmath>
#include <limits>

namespace automorph {

namespace {

struct Filtered {
    double value;        ///< det[a b c] in doubles
    double error_bound;  ///< |value - exact| is below this
};

/// det[a b c] = a . ((b - a) x (c - a)): with differences, small triangles lose no digits. Each of the three
/// sums of products of the expansion is rounded at most 8 times on the way, so the error is below 12 u times
/// the permanent, u = 2^-53 (compare [Shewchuk97] Sec. 4.3); underflow is covered by the additive term.
Filtered filtered_determinant(const Ray& a, const Ray& b, const Ray& c) {
    constexpr double kRelative = 6.0 * std::numeric_limits<double>::epsilon();
    constexpr double kUnderflow = 64.0 * std::numeric_limits<double>::min();
    const double dx = b.x() - a.x(), dy = b.y() - a.y(), dz = b.z() - a.z();
    const double ex = c.x() - a.x(), ey = c.y() - a.y(), ez = c.z() - a.z();
    const double dyez = dy * ez, dzey = dz * ey, dzex = dz * ex, dxez = dx * ez, dxey = dx * ey,
                 dyex = dy * ex;
    const double value = a.x() * (dyez - dzey) + a.y() * (dzex - dxez) + a.z() * (dxey - dyex);
    const double permanent = std::abs(a.x()) * (std::abs(dyez) + std::abs(dzey)) +
                             std::abs(a.y()) * (std::abs(dzex) + std::abs(dxez)) +
                             std::abs(a.z()) * (std::abs(dxey) + std::abs(dyex));
    return {value, kRelative * permanent + kUnderflow};
}

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

}  // namespace

int orientation(const Ray& a, const Ray& b, const Ray& c) {
    const Filtered det = filtered_determinant(a, b, c);
    if (det.value > det.error_bound) return 1;
    if (det.value < -det.error_bound) return -1;
    return CGAL::orientation(Kernel::Vector_3(a.x(), a.y(), a.z()), Kernel::Vector_3(b.x(), b.y(), b.z()),
                             Kernel::Vector_3(c.x(), c.y(), c.z()));
}

double determinant(const Ray& a, const Ray& b, const Ray& c) {
    // Relative error of the plain evaluation that is still good enough to place a point.
    constexpr double kAccurate = 1e-10;
    const Filtered det = filtered_determinant(a, b, c);
    if (det.error_bound <= kAccurate * std::abs(det.value)) return det.value;
    using Exact = CGAL::MP_Float;
    const Exact ax(a.x()), ay(a.y()), az(a.z()), bx(b.x()), by(b.y()), bz(b.z()), cx(c.x()), cy(c.y()),
        cz(c.z());
    return CGAL::to_double(ax * (by * cz - bz * cy) + bx * (cy * az - cz * ay) + cx * (ay * bz - az * by));
}

}  // namespace automorph
