#include "render/turntable/timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "morph/mesh/errors.h"

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
}

double alpha_at(const TimelineOptions& options, double time) {
    if (options.alpha) return *options.alpha;
    double there = time;  // share of the way, rests included
    if (options.loop == Loop::PingPong) there = time < 0.5 ? 2 * time : 2 - 2 * time;
    return ease(options.morph_easing, std::clamp((there - options.hold) / (1 - 2 * options.hold), 0.0, 1.0));
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
    const int steps = repeats(options) ? options.frames : std::max(1, options.frames - 1);
    std::vector<Moment> moments;
    for (int i = 0; i < options.frames; ++i) {
        const double time = static_cast<double>(i) / steps;
        moments.push_back({alpha_at(options, time),
                           options.start + 360 * options.revolutions * ease(options.turn_easing, time)});
    }
    return moments;
}

}  // namespace automorph::turntable
