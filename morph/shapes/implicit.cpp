#include "morph/shapes/implicit.h"

#include <fmt/format.h>

#include <cmath>

#include "morph/mesh/errors.h"

namespace automorph {

ImplicitPoint project(const ImplicitSurface& surface, const Eigen::Vector3d& start) {
    constexpr int kMaxSteps = 60;
    constexpr int kMaxHalvings = 12;
    // Relative to the point. Newton's method squares the distance: one more step from here leaves rounding
    // only.
    constexpr double kClose = 1e-9;

    Eigen::Vector3d p = start;
    FieldSample f = surface(p);
    for (int step = 0; step < kMaxSteps; ++step) {
        const double slope = f.gradient.norm();
        if (!(slope > 0.0) || !std::isfinite(slope)) break;
        const double distance = std::abs(f.value) / slope;
        const Eigen::Vector3d move = -f.value / (slope * slope) * f.gradient;
        Eigen::Vector3d next = p + move;
        FieldSample g = surface(next);
        if (distance <= kClose * (p.norm() + distance)) return {next, g.gradient.normalized()};
        for (int k = 1; k <= kMaxHalvings && !(std::abs(g.value) < std::abs(f.value)); ++k) {
            next = p + std::ldexp(1.0, -k) * move;
            g = surface(next);
        }
        if (!(std::abs(g.value) < std::abs(f.value))) break;
        p = next;
        f = g;
    }
    throw SolverFailure(fmt::format(
        "no point of the surface found near ({:g} {:g} {:g}): field {:g}, slope {:g} at ({:g} {:g} {:g})",
        start.x(), start.y(), start.z(), f.value, f.gradient.norm(), p.x(), p.y(), p.z()));
}

}  // namespace automorph
