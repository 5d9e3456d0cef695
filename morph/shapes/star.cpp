#include "morph/shapes/star.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "morph/mesh/errors.h"
#include "morph/shapes/radial.h"

// An arm is a tapered capsule with smooth ends. u is its direction, a = p . u the place along it and
//     c(a) = (length + sqrt(a^2 + e^2) - sqrt((length - a)^2 + e^2)) / 2
// a smooth clamp of a to [0, length]. Its radius at c is r(c) = base + (tip - base) c / length, and
//     h(p) = |p - c(a) u|^2 / r(c(a))^2
// is 1 on it. The star is sum over the arms of h^-2 = 1, with z stretched. Only square roots are used, so
// that every machine computes the same bits. Length and base follow from where tips and valleys have to be.

namespace automorph {

namespace {

constexpr double kTaper = 0.42;    // radius at the tip over radius at the base
constexpr double kSoftness = 0.2;  // e over the arm's length
// Beyond these limits arms grow together, or are thinner than their triangles.
constexpr int kFewestArms = 3, kMostArms = 12;
constexpr double kSmallestInner = 0.2, kLargestInner = 0.8, kSmallestDepth = 0.05;  // of the outer radius
constexpr int kBisections = 60;                                                     // to the last bit

struct Star {
    std::vector<Eigen::Vector2d> arms;  // unit directions
    double length = 1.0, base = 1.0;
    double stretch = 1.0;  // of z

    FieldSample operator()(const Eigen::Vector3d& point) const {
        const Eigen::Vector3d p(point.x(), point.y(), stretch * point.z());
        const double e = kSoftness * length, slope = (kTaper - 1.0) * base / length;
        double sum = 0.0;                                    // of h^-2
        Eigen::Vector3d gradient = Eigen::Vector3d::Zero();  // of sum, times -1/2
        for (const Eigen::Vector2d& arm : arms) {
            const Eigen::Vector3d u(arm.x(), arm.y(), 0.0);
            const double a = p.dot(u), from_start = std::sqrt(a * a + e * e),
                         from_end = std::sqrt((length - a) * (length - a) + e * e);
            const double c = 0.5 * (length + from_start - from_end);
            const double dc = 0.5 * (a / from_start + (length - a) / from_end);
            const double r = base + slope * c;
            const Eigen::Vector3d offset = p - c * u;
            // Never zero: an axis point gets a large finite weight; the field is far below its zero level
            // there.
            const double h = std::max(offset.squaredNorm() / (r * r), 1e-12);
            const Eigen::Vector3d dh =
                2.0 / (r * r) * (offset - dc * offset.dot(u) * u) - 2.0 * h * slope * dc / r * u;
            const double weight = 1.0 / (h * h);
            sum += weight;
            gradient += weight / h * dh;
        }
        // sum^(-1/4) grows like a distance over the radius.
        const double root = 1.0 / std::sqrt(std::sqrt(sum));
        gradient *= 0.5 * root / sum;
        gradient.z() *= stretch;
        return {root - 1.0, gradient};
    }
};

/// The place where an increasing function changes its sign, in [low, high].
template <typename Function>
double bisect(double low, double high, const Function& function) {
    for (int k = 0; k < kBisections; ++k) {
        const double middle = 0.5 * (low + high);
        (function(middle) > 0.0 ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

/// Arms as long as the tips ask for, as thick as the valleys ask for.
Star fit(const StarParameters& parameters) {
    const double pi = std::acos(-1.0), outer = parameters.outer;
    Star star;
    for (int k = 0; k < parameters.arms; ++k) {
        const double angle = 2.0 * pi * k / parameters.arms;
        star.arms.emplace_back(std::cos(angle), std::sin(angle));
    }
    const Eigen::Vector3d tip(outer, 0.0, 0.0);
    const Eigen::Vector3d valley = parameters.inner * Eigen::Vector3d(std::cos(pi / parameters.arms),
                                                                      std::sin(pi / parameters.arms), 0.0);
    const auto fit_length = [&](double base) {
        star.base = base;
        star.length =
            bisect(1e-3 * outer, 2.0 * outer, [&](double length) {  // its smooth end falls short of it
                star.length = length;
                return -star(tip).value;
            });
    };
    fit_length(bisect(1e-3 * outer, outer, [&](double base) {
        fit_length(base);
        return -star(valley).value;
    }));
    const double top = bisect(0.0, outer, [&](double z) { return star({0.0, 0.0, z}).value; });
    star.stretch = top / parameters.depth;
    return star;
}

}  // namespace

ImplicitSurface star_surface(const StarParameters& parameters) {
    const auto& [arms, outer, inner, depth] = parameters;
    const bool sound = arms >= kFewestArms && arms <= kMostArms && inner >= kSmallestInner * outer &&
                       inner <= kLargestInner * outer && depth >= kSmallestDepth * outer && depth <= outer &&
                       std::isfinite(outer) && outer > 0.0;
    if (!sound) {
        throw InvalidMesh(
            fmt::format("star: {} arms, outer {:g}, inner {:g}, depth {:g}; expected {} to {} arms, inner "
                        "between {:g} and {:g} of "
                        "outer, depth between {:g} and 1 of outer",
                        arms, outer, inner, depth, kFewestArms, kMostArms, kSmallestInner, kLargestInner,
                        kSmallestDepth));
    }
    return fit(parameters);
}

Mesh star(const StarParameters& parameters, const ShapeOptions& options) {
    return radial_shape(star_surface(parameters), 2.0 * std::max(parameters.outer, parameters.depth),
                        options);
}

}  // namespace automorph
