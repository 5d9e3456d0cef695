#include "render/figure/loops.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "render/camera/framing.h"
#include "render/camera/shutter.h"
#include "render/figure/subject.h"

namespace automorph {
namespace {

constexpr double kWholeTurn = 360.0, kTurnOfMorph = 180.0;  // degrees

}  // namespace

double loop_alpha(double frame, int frames) {
    const double from_first = std::abs(frame);
    const double way = 2.0 * std::min(from_first, frames - from_first) / std::max(frames, 1);
    return 0.5 - 0.5 * std::cos(std::numbers::pi * std::min(way, 1.0));
}

FilmLoop::FilmLoop(const Motion& motion, int frames, double shutter, std::optional<Axis> axis)
    : motion_(motion), frames_(frames), axis_(std::move(axis)) {
    const double alpha = std::min(1.0, std::numbers::pi / frames);  // per frame: the slope of the cosine
    const double turn = kTurnOfMorph * alpha + (axis_ ? kWholeTurn / frames : 0.0);
    times_ = render::shutter_times(shutter, render::shutter_steps(shutter * turn));
}

FilmLoop FilmLoop::of_row(const VideoConfig& video, const Motion& motion) {
    return {motion, video.frames, video.shutter, std::nullopt};
}

FilmLoop FilmLoop::on_turntable(const FigureConfig& config, const Motion& motion) {
    const int frames = config.video.turntable;
    render::Bounds bounds;
    for (int i = 0; i <= frames / 2; ++i) bounds.add(motion.at(loop_alpha(i, frames)));
    return {motion, frames, config.video.shutter, Axis{bounds.center(), config.picture.up}};
}

std::vector<Points> FilmLoop::exposure(int index) const {
    std::vector<Points> steps;
    for (const double time : times_) {
        const double at = index + time;
        steps.push_back(motion_.at(loop_alpha(at, frames_)));
        if (axis_) steps.back() = turned(steps.back(), axis_->centre, axis_->up, kWholeTurn * at / frames_);
    }
    return steps;
}

std::vector<Points> FilmLoop::shading(int index) const {
    std::vector<Points> steps;
    for (const double time : times_) {
        const double at = index + time;
        steps.push_back(motion_.shading(loop_alpha(at, frames_)));
        if (axis_) {
            steps.back() =
                turned(steps.back(), Eigen::RowVector3d::Zero(), axis_->up, kWholeTurn * at / frames_);
        }
    }
    return steps;
}

}  // namespace automorph
