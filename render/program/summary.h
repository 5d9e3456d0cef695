#pragma once

#include <string>
#include <vector>

#include "morph/report.h"
#include "render/program/commands.h"

namespace automorph::program {

/// What was found in both meshes and mended, for a reader at a terminal. Several lines, the last one ended.
std::string meshes_summary(const Report& report);

/// What a morph says about itself: the registration and whether it is sure, the maps, the overlay, notes,
/// times.
std::string morph_summary(const Report& report);

/// What makes a morph doubtful, one sentence each; usually none.
std::vector<std::string> doubts(const Report& report);

/// Those as warnings, for where no summary is printed.
void warn_of_doubts(const Report& report, const Surroundings& surroundings);

/// Prints both summaries, or else warns.
void print_morph(const Report& report, const Surroundings& surroundings);

}  // namespace automorph::program
