#pragma once

#include "render/figure/names.h"
#include "render/turntable/timeline.h"

namespace automorph::program {

// Names of a timeline's values on the command line and in the records of frames.

inline constexpr std::array kEasings{Named<turntable::Easing>{"linear", turntable::Easing::Linear},
                                     Named<turntable::Easing>{"smooth", turntable::Easing::Smooth}};
inline constexpr std::array kLoops{Named<turntable::Loop>{"ping-pong", turntable::Loop::PingPong},
                                   Named<turntable::Loop>{"once", turntable::Loop::Once}};

}  // namespace automorph::program
