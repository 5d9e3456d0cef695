#pragma once

#include <Eigen/Core>
#include <string>

namespace automorph::program {

/// A direction from the command line: "x", "-z" or three numbers "0,1,0.5".
/// @throws ConfigError if it is neither, or has no length
Eigen::Vector3d parse_axis(const std::string& text);

/// Where one looks at a shape whose up axis is given: along y, as the generated heads are seen from the
/// front, and along -z where y is up, as most modelling programs and glTF have it.
Eigen::Vector3d usual_view(const Eigen::Vector3d& up);

}  // namespace automorph::program
