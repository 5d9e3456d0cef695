#pragma once

#include <vector>

#include "morph/morph.h"

namespace automorph {

/// Looks at frames of a morph: a valid map can still give an ugly one. Counts triangles that face against
/// both ends, triangles that pass through others, area and volume beside those between the ends', and the
/// smallest angle. Costs a search per frame, some 2 us a triangle; not part of morph().
/// @param alphas  of the frames; the ends, which are looked at in any case, are what others are held against
std::vector<FrameReport> check_frames(const Morph& morph, Interpolation scheme = Interpolation::Slerp,
                                      const std::vector<double>& alphas = {0.1, 0.3, 0.5, 0.7, 0.9});

/// The morph's report with its frames checked, and a note for each kind of fault that a user should look at.
Report report_with_frames(const Morph& morph, Interpolation scheme = Interpolation::Slerp);

}  // namespace automorph
