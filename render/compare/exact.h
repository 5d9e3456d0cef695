#pragma once

#include "render/compare/comparison.h"

namespace automorph::render {

/// Every bit counts, in any number of channels. The one test counts the values that differ and tells where
/// the largest difference is; severities are shares of that one.
/// @throws Error if sizes or channels differ
Comparison compare_exact(const Image& golden, const Image& found);

}  // namespace automorph::render
