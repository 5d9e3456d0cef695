#pragma once

#include <filesystem>

#include "render/figure/figure.h"

/// The golden pictures of configs/fig7.yaml: one place for the test and for making them anew.
namespace golden {

/// configs/fig7.yaml itself.
automorph::FigureConfig config();

/// Small, few samples, Embree's instruction set pinned.
automorph::FigureOptions options();

/// File of a cell in golden/fig7.
std::filesystem::path file(std::size_t row, std::size_t column);

}  // namespace golden
