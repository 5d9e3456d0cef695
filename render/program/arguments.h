#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "morph/morph.h"
#include "morph/shapes/head.h"
#include "morph/shapes/shapes.h"
#include "render/program/diff_arguments.h"

/// What the command line asks for, one struct per subcommand. Its reading is CLI11's only door.
namespace automorph::program {

struct FigureArguments {
    std::vector<std::filesystem::path> configs;
    std::optional<std::filesystem::path> out;  ///< folder; with several configs, one folder per config in it
    std::optional<int> spp;
    double scale = 1.0;
    bool layers = false;
};

struct MorphArguments {
    std::filesystem::path source, target;
    int frames = 5;
    std::filesystem::path out;             ///< pattern of the numbered frames; empty: none are written
    std::filesystem::path correspondence;  ///< CSV; empty: not written
    std::filesystem::path report;          ///< JSON; empty: not written
    MorphOptions options;
    Interpolation interpolation = Interpolation::Slerp;
};

struct EllipsoidArguments {
    std::filesystem::path out;
    std::vector<double> semi_axes{1.0, 0.8, 0.6};
    ShapeOptions options;
};

struct StarArguments {
    std::filesystem::path out;
    StarParameters parameters;
    ShapeOptions options;
};

struct HeadArguments {
    std::filesystem::path out;
    HeadPreset preset = HeadPreset::Neutral;
    std::array<std::optional<double>, kHeadParameterCount> proportions;  ///< in place of the preset's
    HeadCrop crop = HeadCrop::Closed;
    ShapeOptions options;
};

struct InfoArguments {
    std::vector<std::filesystem::path> meshes;
};

struct ConfigArguments {
    bool explain = false;                        ///< print every key
    std::vector<std::filesystem::path> checked;  ///< configs to check
};

using Command = std::variant<FigureArguments, MorphArguments, EllipsoidArguments, StarArguments,
                             HeadArguments, InfoArguments, ConfigArguments, DiffArguments>;

struct Arguments {
    Command command;
    bool quiet = false;
    int threads = 0;  ///< 0: all
};

/// Either what to do, or the status to exit with at once (help, version and errors have then been printed; an
/// error is one line on stderr and status 1, 2 for `diff`).
std::variant<Arguments, int> read_arguments(int count, const char* const* values);

}  // namespace automorph::program
