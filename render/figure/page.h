#pragma once

#include <string>

#include "render/figure/figure.h"

namespace automorph {

/// The figure as one page that needs no network: cells, frames to scrub through, videos, metrics and config
/// are inside; only videos of many megabytes lie beside it.
std::string page_html(const FigureConfig& config, const Figure& figure);

}  // namespace automorph
