#pragma once

#include "render/figure/figure.h"

namespace automorph {

/// The stage's place with the look's surface.
PictureConfig look_on_stage(const StageConfig& stage, const LookConfig& look);

/// Show::Looks: the source in each look (columns) on each stage (rows).
/// @throws as render_figure() does
void picture_looks(const FigureConfig& config, const FigureOptions& options, Figure& figure);

}  // namespace automorph
