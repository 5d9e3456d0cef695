#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "morph/export/write_glb.h"
#include "morph/morph.h"
#include "morph/shapes/head.h"
#include "morph/shapes/shapes.h"
#include "render/figure/quality.h"
#include "render/program/diff_arguments.h"
#include "render/program/log.h"
#include "render/turntable/timeline.h"

/// What the command line asks for, one struct per subcommand. arguments.cpp and option_groups.h
/// are CLI11's only doors.
namespace automorph::program {

struct FigureArguments {
    std::vector<std::filesystem::path> configs;
    std::optional<std::filesystem::path> out;  ///< folder; with several configs, one folder per config in it
    std::optional<int> spp;
    double scale = 1.0;
    Quality quality = Quality::Normal;
    std::string rows, cells, frames;     ///< selections, e.g. "1,3-4"; empty: all
    std::vector<std::string> overrides;  ///< KEY=VALUE
    bool dry_run = false;                ///< only tell what would be made
    bool denoise = false;                ///< every cell, as a preview
    bool layers = false;                 ///< in the EXR files of cells
};

struct MorphArguments {
    std::filesystem::path source, target;
    int frames = 5;                        ///< numbered ones
    std::filesystem::path out;             ///< a .glb, or the pattern of the numbered frames; empty: neither
    double seconds = 2.0;                  ///< that a .glb plays, one way
    bool ping_pong = false;                ///< of a .glb
    UpAxis up = UpAxis::Y;                 ///< of a .glb
    std::filesystem::path correspondence;  ///< CSV; empty: not written
    std::filesystem::path report;          ///< JSON; empty: not written
    MorphOptions options;
    Interpolation interpolation = Interpolation::Slerp;
};

struct TurntableArguments {
    std::filesystem::path source;
    std::filesystem::path target;                  ///< empty: the source alone turns
    std::filesystem::path out = "turntable_.png";  ///< pattern of the numbered frames, or a video
    turntable::TimelineOptions timeline;
    std::string frame_range;          ///< "A-B", "A-", "A"; empty: all
    std::string up = "y", view;       ///< axes, as parse_axis() reads them; no view: that of the up axis
    double elevation = 14, fov = 20;  ///< degrees
    double margin = 0.06;             ///< free on each side, fraction of half the picture
    bool flat = false;                ///< facets instead of smooth normals
    int width = 640, height = 640, spp = 64;
    std::uint64_t seed = 1;  ///< of the noise and of the registration
    double fps = 24;         ///< of a video
    bool redo = false;       ///< frames that are finished, too
    MorphOptions morph;
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
    bool json = false;
};

struct ConfigArguments {
    bool explain = false;                        ///< print every key
    bool schema = false;                         ///< print the JSON Schema
    std::vector<std::filesystem::path> checked;  ///< configs to check
};

using Command = std::variant<FigureArguments, MorphArguments, TurntableArguments, EllipsoidArguments,
                             StarArguments, HeadArguments, InfoArguments, ConfigArguments, DiffArguments>;

struct Arguments {
    Command command;
    LogLevel log_level = LogLevel::Info;
    bool quiet = false;  ///< the level is below Info
    int threads = 0;     ///< 0: all
};

/// Either what to do, or the status to exit with at once (help, version, completion and errors have then been
/// printed; an error is one line on stderr and status 1, 2 for `diff`).
std::variant<Arguments, int> read_arguments(int count, const char* const* values);

}  // namespace automorph::program
