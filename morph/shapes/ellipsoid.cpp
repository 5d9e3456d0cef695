#include <fmt/format.h>

#include "morph/mesh/errors.h"
#include "morph/shapes/crop.h"
#include "morph/shapes/radial.h"
#include "morph/shapes/shapes.h"

namespace automorph {

namespace {

constexpr double kWidestOpening = 0.9;

}  // namespace

Mesh ellipsoid(const Eigen::Vector3d& semi_axes, const ShapeOptions& options, double opening) {
    if (!(semi_axes.minCoeff() > 0.0) || !semi_axes.allFinite()) {
        throw InvalidMesh(
            fmt::format("ellipsoid: semi-axes are {:g} {:g} {:g}, expected three positive lengths",
                        semi_axes.x(), semi_axes.y(), semi_axes.z()));
    }
    const Eigen::Array3d inverse_square = semi_axes.array().square().inverse();
    const ImplicitSurface surface = [&](const Eigen::Vector3d& p) -> FieldSample {
        const Eigen::Vector3d scaled = (inverse_square * p.array()).matrix();
        return {p.dot(scaled) - 1.0, 2.0 * scaled};
    };
    if (!(opening >= 0.0 && opening <= kWidestOpening))
        throw InvalidMesh(
            fmt::format("ellipsoid: the opening is {:g}, expected 0 to {}", opening, kWidestOpening));
    const double radius = 2.0 * semi_axes.maxCoeff();
    if (opening == 0.0) return radial_shape(surface, radius, options);
    const double bottom = semi_axes.z() * (2.0 * opening - 1.0);
    const ImplicitSurface below = [&](const Eigen::Vector3d& p) -> FieldSample {
        return {bottom - p.z(), {0.0, 0.0, -1.0}};
    };
    ShapeOptions unposed;
    unposed.triangles = options.triangles;
    unposed.seed = options.seed;
    return posed(crop(radial_shape(surface, radius, unposed), surface, below), options);
}

}  // namespace automorph
