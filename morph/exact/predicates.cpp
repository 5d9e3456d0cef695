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

/// Forward error bound of the expansion along the first column: [Shewchuk97] Sec. 4.3 gives (7 + 56 eps) eps times
/// the permanent for orient3d, whose differences are exact here; 8 eps is a safe constant. Underflow is covered by the
/// additive term.
Filtered filtered_determinant(const Ray& a, const Ray& b, const Ray& c) {
    constexpr double kRelative = 8.0 * std::numeric_limits<double>::epsilon() / 2.0;
    constexpr double kUnderflow = 64.0 * std::numeric_limits<double>::min();
    const double bycz = b.y() * c.z(), bzcy = b.z() * c.y();
    const double cyaz = c.y() * a.z(), czay = c.z() * a.y();
    const double aybz = a.y() * b.z(), azby = a.z() * b.y();
    const double value = a.x() * (bycz - bzcy) + b.x() * (cyaz - czay) + c.x() * (aybz - azby);
    const double permanent = std::abs(a.x()) * (std::abs(bycz) + std::abs(bzcy)) +
                             std::abs(b.x()) * (std::abs(cyaz) + std::abs(czay)) +
                             std::abs(c.x()) * (std::abs(aybz) + std::abs(azby));
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
    constexpr double kAccurate = 1e-12;
    const Filtered det = filtered_determinant(a, b, c);
    if (det.error_bound <= kAccurate * std::abs(det.value)) return det.value;
    using Exact = CGAL::MP_Float;
    const Exact ax(a.x()), ay(a.y()), az(a.z()), bx(b.x()), by(b.y()), bz(b.z()), cx(c.x()), cy(c.y()), cz(c.z());
    return CGAL::to_double(ax * (by * cz - bz * cy) + bx * (cy * az - cz * ay) + cx * (ay * bz - az * by));
}

}  // namespace automorph
