#include <fmt/format.h>

#include "morph/mesh/errors.h"
#include "morph/shapes/radial.h"
#include "morph/shapes/shapes.h"

namespace automorph {

Mesh ellipsoid(const Eigen::Vector3d& semi_axes, const ShapeOptions& options) {
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
    return radial_shape(surface, 2.0 * semi_axes.maxCoeff(), options);
}

}  // namespace automorph
