#pragma once

#include <string>

#include "morph/report.h"

namespace automorph::program {

/// What a morph says about itself, for a reader at a terminal: what was found and mended, the registration
/// and how sure it is, the maps, the overlay, notes and times. Several lines, the last one ended.
std::string summary(const Report& report);

}  // namespace automorph::program
