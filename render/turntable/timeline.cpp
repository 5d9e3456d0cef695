#include "render/turntable/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "morph/mesh/errors.h"
#include "render/camera/shutter.h"

namespace automorph::turntable {
namespace {

void check(const TimelineOptions& options) {
    if (options.frames < 1)
        throw ConfigError(fmt::format("turntable: {} frames; expected at least 1", options.frames));
    if (!std::isfinite(options.start) || !std::isfinite(options.revolutions))
        throw ConfigError("turntable: start and revolutions must be finite");
    if (!(options.hold >= 0 && options.hold < 0.5))
        throw ConfigError(fmt::format("turntable: hold is {}; it must be in [0, 0.5)", options.hold));
    if (options.alpha && !(*options.alpha >= 0 && *options.alpha <= 1))
        throw ConfigError(fmt::format("turntable: alpha is {}; it must be in [0, 1]", *options.alpha));
    if (!(options.shutter >= 0 && options.shutter <= 1))
        throw ConfigError(fmt::format("turntable: shutter is {}; it must be in [0, 1]", options.shutter));
}

double alpha_at(const TimelineOptions& options, double time) {
    if (options.alpha) return *options.alpha;
    double there = time;  // share of the way, rests included
    if (options.loop == Loop::PingPong) there = time < 0.5 ? 2 * time : 2 - 2 * time;
    return ease(options.morph_easing, std::clamp((there - options.hold) / (1 - 2 * options.hold), 0.0, 1.0));
}

/// @param frame  its number, which may be between two, or beyond the sequence by less than one
Moment moment_at(const TimelineOptions& options, double frame) {
    const bool repeating = repeats(options);
    const int steps = repeating ? options.frames : std::max(1, options.frames - 1);
    const double time = frame / steps, rounds = repeating ? std::floor(time) : 0;
    const double within = std::clamp(time - rounds, 0.0, 1.0);
    return {alpha_at(options, within),
            options.start + 360 * options.revolutions * (rounds + ease(options.turn_easing, within))};
}

/// By how much anything turns from one to the other at most.
double turn_between(const Moment& a, const Moment& b) {
    constexpr double kTurnOfMorph = 180;
    return std::abs(b.degrees - a.degrees) + kTurnOfMorph * std::abs(b.alpha - a.alpha);
}

}  // namespace

double ease(Easing easing, double t) {
    return easing == Easing::Linear ? t : t * t * (3 - 2 * t);
}

bool repeats(const TimelineOptions& options) {
    const bool comes_back = options.alpha || options.loop == Loop::PingPong;
    return comes_back && options.revolutions == std::round(options.revolutions);
}

std::vector<Moment> timeline(const TimelineOptions& options) {
    check(options);
    std::vector<Moment> moments;
    for (int i = 0; i < options.frames; ++i) moments.push_back(moment_at(options, i));
    return moments;
}

std::vector<Exposure> exposures(const TimelineOptions& options) {
    check(options);
    double turn = 0;
    for (int i = 0; i < options.frames; ++i) {
        const Moment middle = moment_at(options, i);
        turn = std::max(turn, turn_between(moment_at(options, i - 0.5 * options.shutter), middle) +
                                  turn_between(middle, moment_at(options, i + 0.5 * options.shutter)));
    }
    const std::vector<double> times = render::shutter_times(options.shutter, render::shutter_steps(turn));
    std::vector<Exposure> frames(static_cast<std::size_t>(options.frames));
    for (int i = 0; i < options.frames; ++i) {
        for (const double time : times)
            frames[static_cast<std::size_t>(i)].steps.push_back(moment_at(options, i + time));
    }
    return frames;
}

}  // namespace automorph::turntable
