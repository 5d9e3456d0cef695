#pragma once

#include <Eigen/Core>

#include "render/math/vec.h"

namespace automorph::render {

/// Matplotlib's map "viridis" (van der Walt and Smith 2015, public domain), whose lightness rises evenly and
/// which colour-blind people can read: linear colour of a value in [0, 1]; values beyond are clamped, NaN is
/// mid-grey.
Color viridis(double value);

/// Colours of a scalar field, `low` being dark blue and `high` yellow: #V x 3, linear, to be given as
/// MeshOptions::vertex_colors.
Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> viridis_colors(const Eigen::VectorXd& values,
                                                                         double low, double high);

}  // namespace automorph::render
