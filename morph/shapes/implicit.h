#pragma once

#include <Eigen/Core>
#include <functional>

namespace automorph {

/// A scalar field at a point.
struct FieldSample {
    double value;
    Eigen::Vector3d gradient;
};

/// A closed surface as the zero level of a field: negative inside, positive outside, with its gradient. It
/// need not be a distance, but |value| / |gradient| should be near the distance close to the surface.
using ImplicitSurface = std::function<FieldSample(const Eigen::Vector3d&)>;

/// A point of the surface and its outward unit normal.
struct ImplicitPoint {
    Eigen::Vector3d position, normal;
};

/// The point of the surface that Newton's method reaches from `start` along the gradient: close to the
/// nearest one when `start` is close to the surface. Accurate to rounding.
/// @throws SolverFailure if it does not converge (gradient zero or field not smooth near `start`)
ImplicitPoint project(const ImplicitSurface& surface, const Eigen::Vector3d& start);

}  // namespace automorph
