#pragma once

#include "render/figure/config_reader.h"

/// The part of the table of keys that says how cells are pictured. Internal to the config readers.
namespace automorph::config {

Section<PictureConfig> picture_section();
Section<LookConfig> look_section();
Section<StageConfig> stage_section();

}  // namespace automorph::config
