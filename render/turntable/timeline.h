#pragma once

#include <optional>
#include <vector>

/// Turntables: a shape, or a morph, turns on a floor under fixed light.
namespace automorph::turntable {

/// How time becomes progress.
enum class Easing {
    Linear,  ///< constant speed
    Smooth   ///< rest at both ends: 3 t^2 - 2 t^3
};

/// @param t  in [0, 1], as is the result
double ease(Easing easing, double t);

/// What a morph does in the sequence.
enum class Loop {
    Once,     ///< from the source to the target
    PingPong  ///< and back again
};

struct TimelineOptions {
    int frames = 96;
    double start = 0;        ///< degrees the shape is turned before the first frame
    double revolutions = 1;  ///< counter-clockwise seen from above; may be negative or a fraction
    Easing turn_easing = Easing::Linear;
    std::optional<double> alpha;  ///< the shape that turns; empty: it morphs
    Loop loop = Loop::PingPong;
    Easing morph_easing = Easing::Smooth;
    double hold = 0;     ///< share of the sequence in which the morph rests at each of its ends, in [0, 0.5)
    double shutter = 0;  ///< share of the time between two frames during which the shutter is open, in [0, 1]
};

/// What a frame shows.
struct Moment {
    double alpha;    ///< of the morph
    double degrees;  ///< the shape is turned by, counter-clockwise seen from above

    bool operator==(const Moment&) const = default;
};

/// What a frame shows while the shutter is open.
struct Exposure {
    std::vector<Moment> steps;  ///< evenly from its opening to its closing; one alone: nothing is blurred

    /// The frame's own. @pre there are steps
    const Moment& middle() const { return steps[steps.size() / 2]; }
};

/// Whether the sequence can be played over and over: whole revolutions, and the morph, if any, comes back.
bool repeats(const TimelineOptions& options);

/// The frames in order. Of a sequence that repeats, the frame after the last is the first one and is not
/// there twice; of others, the last frame is the end of the motion.
/// @throws ConfigError if an option is out of range
std::vector<Moment> timeline(const TimelineOptions& options);

/// The frames as the shutter sees them, open for as long before a frame's moment as after it. All have
/// render::shutter_steps() of the fastest frame, where a morph counts as half a turn: it turns what it moves
/// by no more. Before and after a sequence that does not repeat, all is at rest.
/// @throws ConfigError if an option is out of range
std::vector<Exposure> exposures(const TimelineOptions& options);

}  // namespace automorph::turntable
