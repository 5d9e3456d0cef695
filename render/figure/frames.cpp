#include "render/figure/frames.h"

namespace automorph {

FrameSequence frames_of(const Morph& morph, const std::vector<double>& alphas, Interpolation scheme) {
    FrameSequence sequence{morph.triangles(), alphas, {}, morph.endpoints().a};
    for (const double alpha : alphas) sequence.frames.push_back(morph.frame(alpha, scheme));
    return sequence;
}

}  // namespace automorph
