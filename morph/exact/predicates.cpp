#include "morph/exact/predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/MP_Float.h>

#include <cmath>

namespace automorph {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

}  // namespace

int detail::exact_orientation(const Ray& a, const Ray& b, const Ray& c) {
    return CGAL::orientation(Kernel::Vector_3(a.x(), a.y(), a.z()), Kernel::Vector_3(b.x(), b.y(), b.z()),
                             Kernel::Vector_3(c.x(), c.y(), c.z()));
}

double determinant(const Ray& a, const Ray& b, const Ray& c) {
    // Relative error of the plain evaluation that is still good enough to place a point.
    constexpr double kAccurate = 1e-10;
    const detail::Filtered det = detail::filtered_determinant(a, b, c);
    if (det.error_bound <= kAccurate * std::abs(det.value)) return det.value;
    using Exact = CGAL::MP_Float;
    const Exact ax(a.x()), ay(a.y()), az(a.z()), bx(b.x()), by(b.y()), bz(b.z()), cx(c.x()), cy(c.y()),
        cz(c.z());
    return CGAL::to_double(ax * (by * cz - bz * cy) + bx * (cy * az - cz * ay) + cx * (ay * bz - az * by));
}

}  // namespace automorph
