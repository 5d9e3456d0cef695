#pragma once

#include "render/compare/comparison.h"

namespace automorph::render {

/// How far two pictures of one seed may be apart. The reasons for the defaults are measured in
/// golden/README.md: rounding of other compilers and processors passes, an albedo 1 % brighter does not.
struct SameSeedLimits {
    double rmse = 0.001;   ///< root of the mean squared difference, in radiance (a white background has 1)
    double outlier = 0.1;  ///< a pixel that differs by more in a channel is an outlier, in radiance
    int outliers = 2;      ///< so many are accepted: single paths that rounding sent past an edge
};

/// For pictures rendered with the same seed, by another compiler or on another machine: their noise is the
/// same but for single paths. Two tests, of the mean squared difference (told with the worst 8 x 8 block) and
/// of the number of outliers (told with the worst pixel). Severities are shares of `outlier`.
/// @throws Error if sizes or channels differ
Comparison compare_same_seed(const Image& golden, const Image& found, const SameSeedLimits& limits = {});

}  // namespace automorph::render
