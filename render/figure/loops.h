#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "render/figure/config.h"
#include "render/figure/figure.h"

/// What the films of a figure show, and when.
namespace automorph {

/// Alpha of a frame of a loop: 0 at the first, 1 halfway, slow at both; between frames, too, and the same as
/// far before the first as after it.
/// @pre -frames < frame < frames
double loop_alpha(double frame, int frames);

/// A row's motion there and back, at rest or on a turntable. Its moments in a frame are those at which the
/// shutter is open, evenly from its opening to its closing and the frame's own in the middle: as many as
/// render::shutter_steps() wants for the fastest frame, where a morph turns what it moves by no more than
/// half a turn; one alone if the shutter is never open. The way back mirrors the way there, so that both can
/// share their pictures.
class FilmLoop {
public:
    /// Of `video.frames` frames.
    static FilmLoop of_row(const VideoConfig& video, const Motion& motion);

    /// Of `video.turntable` frames: turned about picture.up, through the middle of the whole motion.
    static FilmLoop on_turntable(const FigureConfig& config, const Motion& motion);

    /// Positions of a frame at its moments, #V x 3 each.
    std::vector<Points> exposure(int index) const;

    /// Motion::shading() at the same moments, turned alike.
    std::vector<Points> shading(int index) const;

    /// Positions at the frame's own moment, not turned.
    Points unturned(int index) const { return motion_.at(loop_alpha(index, frames_)); }

    /// Moments of each frame.
    int time_steps() const { return static_cast<int>(times_.size()); }

private:
    struct Axis {
        Eigen::RowVector3d centre;
        Eigen::Vector3d up;
    };
    FilmLoop(const Motion& motion, int frames, double shutter, std::optional<Axis> axis);

    const Motion& motion_;
    int frames_;
    std::optional<Axis> axis_;   ///< of the turntable
    std::vector<double> times_;  ///< in frames from a frame's own moment
};

}  // namespace automorph
