#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "render/figure/config.h"
#include "render/figure/frames.h"

namespace automorph {

/// What the ends of the colour map stand for.
struct ColorScale {
    double low = 0, high = 1;
    std::string meaning;  ///< with its unit, for the legend
};

/// A number per vertex (#V) of each frame, by which it is coloured:
///  - Curvature: mean curvature times the root of the area, smoothed over 2 % of that root, so that single
///    triangles do not show; positive where convex. On borders the mean of the inner neighbours, NaN without
///    any.
///  - Displacement: distance of the vertex from where the best rigid motion of the whole source (weighted by
///    area) brings it; scene units.
///  - Distortion: per triangle max(s1, 1 / s2) of the singular values s1 >= s2 of its linear map from the
///    source, at vertices the mean weighted by the source's area; 1 is isometric. NaN where the source has no
///    area.
/// @pre field is not None
std::vector<Eigen::VectorXd> color_field(ColorField field, const FrameSequence& sequence);

/// The same of one frame. @param source  the frame at alpha = 0
Eigen::VectorXd color_field(ColorField field, const Mesh& source, const Points& frame);

/// One scale for all frames: from the least value there can be, or the 2nd percentile of curvatures, to the
/// 98th percentile, both rounded to two digits. Values beyond take the colour of the end.
ColorScale color_scale(ColorField field, const std::vector<std::vector<Eigen::VectorXd>>& values);

}  // namespace automorph
