#pragma once

#include <Eigen/Core>

namespace automorph::render {

using Vec3 = Eigen::Vector3f;  ///< a point or direction in world space
using Color = Eigen::Array3f;  ///< linear Rec.709/sRGB primaries; radiance in W/(sr m^2), or a reflectance

}  // namespace automorph::render
