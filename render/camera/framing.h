#pragma once

#include <Eigen/Core>
#include <vector>

#include "morph/mesh/mesh.h"
#include "render/camera/camera.h"

namespace automorph::render {

struct FramingOptions {
    Eigen::Vector3d direction{0.0, 1.0, -0.25};  ///< the view, from the camera to the shape; any length
    Eigen::Vector3d up{0.0, 0.0, 1.0};
    double vertical_fov = 20.0;  ///< degrees
    double aspect = 1.0;         ///< picture width / height
    double margin = 0.06;        ///< free border on each side, as a fraction of the half picture
};

/// A turn about an axis, from one angle to another (degrees, counter-clockwise seen against the axis).
struct Sweep {
    Eigen::Vector3d point{0.0, 0.0, 0.0};  ///< on the axis
    Eigen::Vector3d axis{0.0, 0.0, 1.0};   ///< any length > 0
    double from = 0.0, to = 360.0;         ///< either may be the larger
};

/// The tightest pinhole camera of a given direction that has all points within the picture less the margin.
///
/// Each point bounds the camera's place by four planes through the picture's sides, so the answer is exact
/// and needs four minima only: points can be streamed, and one camera holds for a whole morph and all its
/// rows. In the direction that does not decide the distance, the free space is shared between both sides.
class Framing {
public:
    /// @throws ConfigError as PictureCamera does, or if aspect <= 0 or margin is outside [0, 1)
    explicit Framing(const FramingOptions& options);

    /// Takes in the vertices of a frame (#V x 3); rows that are not finite are left out.
    void add(const Points& V);

    /// Takes in all that the vertices pass while they turn: exact, at angles between frames, too.
    void add(const Points& V, const Sweep& sweep);

    /// @throws Error if no finite point was added, or if floats cannot show a shape so small or so large
    Camera camera() const;

private:
    FramingOptions options_;
    Eigen::Vector3d right_, up_, forward_;  ///< orthonormal
    double tan_x_, tan_y_;                  ///< of the half picture less the margin
    double min_right_, min_left_, min_top_, min_bottom_, nearest_, farthest_;
};

/// Framing of all frames at once.
Camera frame_all(const std::vector<Points>& frames, const FramingOptions& options = {});

}  // namespace automorph::render
