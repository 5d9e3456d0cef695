#pragma once

#include "render/figure/color_field.h"
#include "render/film/image.h"

namespace automorph {

/// The colour map as a bar with the numbers at its ends and in its middle, and what they mean, on white.
/// @param width  of the bar, pixels
/// @param size   of the text, pixels
/// @throws IoError if the font is missing
render::Image make_legend(const ColorScale& scale, int width, int size);

}  // namespace automorph
