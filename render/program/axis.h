#pragma once

#include <Eigen/Core>
#include <string>

namespace automorph::program {

/// A direction from the command line: "x", "-z" or three numbers "0,1,0.5".
/// @throws ConfigError if it is neither, or has no length
Eigen::Vector3d parse_axis(const std::string& text);

/// Where one looks at a shape from the front, given its up axis: along -z where y is up, as generated heads,
/// glTF and most modelling programs have it; along y otherwise.
Eigen::Vector3d usual_view(const Eigen::Vector3d& up);

}  // namespace automorph::program
