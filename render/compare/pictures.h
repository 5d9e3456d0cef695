#pragma once

#include "render/compare/comparison.h"

/// Pictures of a comparison, for looking at. Small ones are enlarged, each pixel to a square.
namespace automorph::render {

/// The severity of each pixel in the colours of viridis, with a legend: dark blue is no difference, bright
/// yellow twice the severity unit or more (once, where the unit is the largest difference).
/// @throws IoError if the font of the legend is missing
Image heat_map(const Comparison& comparison);

/// Golden, new and heat map beside each other, with captions. Grey pictures are shown as such.
/// @throws Error if the sizes differ, IoError as above
Image side_by_side(const Image& golden, const Image& found, const Comparison& comparison);

}  // namespace automorph::render
