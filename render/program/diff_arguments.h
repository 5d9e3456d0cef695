#pragma once

#include <array>
#include <filesystem>

#include "render/compare/same_seed.h"
#include "render/compare/statistical.h"
#include "render/figure/names.h"

namespace CLI {
class App;
}

namespace automorph::program {

enum class DiffMode { Auto, Exact, SameSeed, Statistical };

inline constexpr std::array kDiffModes{
    Named<DiffMode>{"auto", DiffMode::Auto}, Named<DiffMode>{"exact", DiffMode::Exact},
    Named<DiffMode>{"same-seed", DiffMode::SameSeed}, Named<DiffMode>{"statistical", DiffMode::Statistical}};

/// The status that `automorph diff` exits with.
enum class DiffStatus { Same = 0, Different = 1, CannotCompare = 2 };

struct DiffArguments {
    std::filesystem::path golden, found;     ///< two files, or two folders
    DiffMode mode = DiffMode::Auto;          ///< auto: statistical where both hold the layers, else same-seed
    render::StatisticalOptions statistical;  ///< its rate is that of the whole run
    render::SameSeedLimits same_seed;
    std::filesystem::path heatmap;       ///< PNG, or a folder for the pictures that differ; empty: none
    std::filesystem::path side_by_side;  ///< likewise
    std::filesystem::path report;        ///< JSON; empty: not written
    bool accept = false;                 ///< replace goldens by new pictures
};

void add_diff(CLI::App& app, DiffArguments& arguments);

}  // namespace automorph::program
