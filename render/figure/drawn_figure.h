#pragma once

#include "render/figure/config.h"
#include "render/figure/figure.h"

namespace automorph {

/// Fills in the rows, reports and camera of a figure whose config shows something else than a morph.
/// @param figure  with its size and samples set
void draw_figure(const FigureConfig& config, const FigureOptions& options, Figure& figure);

}  // namespace automorph
