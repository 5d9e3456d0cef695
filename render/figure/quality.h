#pragma once

#include "render/figure/config.h"

namespace automorph {

/// How much time pictures may take.
enum class Quality {
    Draft,   ///< cells of half the size with an eighth of the paths, short rough videos, no turntable
    Normal,  ///< as the config says
    Final,   ///< twice the size, four times the paths: for print
};

/// Changes a config's pictures and videos accordingly.
void apply_quality(Quality quality, FigureConfig& config);

}  // namespace automorph
