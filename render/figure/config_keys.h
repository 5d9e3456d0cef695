#pragma once

#include "render/figure/config_reader.h"

namespace automorph::config {

/// The table of a figure's keys: it reads, checks and documents.
const Section<FigureConfig>& figure_section();

}  // namespace automorph::config
