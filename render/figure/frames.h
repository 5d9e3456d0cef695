#pragma once

#include <vector>

#include "morph/morph.h"

namespace automorph {

/// What rendering sees of a morph: one connectivity, positions per frame.
struct FrameSequence {
    Triangles triangles;         ///< #F x 3
    std::vector<double> alphas;  ///< ascending, in [0, 1]
    std::vector<Points> frames;  ///< per alpha: #V x 3, world frame
    Points source;               ///< the frame at alpha = 0
};

/// @pre every alpha is in [0, 1]
FrameSequence frames_of(const Morph& morph, const std::vector<double>& alphas, Interpolation scheme);

}  // namespace automorph
