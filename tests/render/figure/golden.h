#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/figure/figure.h"

/// The golden pictures of the figures: one place for the test and for making them anew.
namespace golden {

/// "fig1" ... "fig8".
const std::vector<std::string>& names();

/// configs/<name>.yaml, with coarser meshes and three columns where it has generated heads.
automorph::FigureConfig config(const std::string& name);

/// Small, few samples, Embree's instruction set pinned.
automorph::FigureOptions options();

/// File of a cell in golden/<name>.
std::filesystem::path file(const std::string& name, std::size_t row, std::size_t column);

}  // namespace golden
