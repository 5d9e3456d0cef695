#pragma once

#include <filesystem>
#include <string>

#include "render/figure/figure.h"

namespace automorph::program {

/// What `automorph figure` would make of a config, and an estimate of its time. Several lines, the
/// last one ended.
/// @throws ConfigError if the selections do not fit the config
std::string figure_plan(const FigureConfig& config, const FigureOptions& options,
                        const std::filesystem::path& folder);

}  // namespace automorph::program
