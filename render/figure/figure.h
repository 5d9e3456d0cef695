#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "morph/report.h"
#include "render/camera/camera.h"
#include "render/figure/config.h"
#include "render/figure/progress.h"
#include "render/film/image.h"
#include "render/film/layers.h"

/// From a config to pictures: meshes, one morph per different row, frames, one camera, cells, sheet.
namespace automorph {

/// What a run may change without touching the config.
struct FigureOptions {
    std::optional<int> spp;     ///< instead of the config's, >= 1
    double scale = 1.0;         ///< of the cells' width and height, > 0
    bool layers = false;        ///< fills FigureCell::layers of rendered cells
    int threads = 0;            ///< of the path tracer; 0: all
    std::string embree_config;  ///< "isa=sse4.2" makes the pictures the same on every x86-64 machine
    Progress progress;
};

struct FigureCell {
    render::Image image;                   ///< linear RGB
    std::optional<render::Layers> layers;  ///< if asked for and nothing is drawn over the picture
    std::string label;                     ///< what stands above it
    double alpha = 0;                      ///< of a morph's frame
    double seconds = 0;                    ///< of rendering
    std::uint64_t rays = 0, bad_samples = 0;
};

struct FigureRow {
    RowConfig config;
    std::size_t morph = 0;  ///< index into Figure::morphs
    std::vector<FigureCell> cells;
};

struct Figure {
    std::vector<Report> morphs;  ///< one per different set of options; rows share them
    std::vector<FigureRow> rows;
    render::Camera camera;  ///< of all cells
    int width = 0, height = 0, spp = 0;
    double load_seconds = 0, morph_seconds = 0, render_seconds = 0;
};

/// Computes all cells; writes nothing.
/// @throws IoError, InvalidMesh, SolverFailure as load_mesh() and morph() do, ConfigError if an option is out
/// of range
Figure render_figure(const FigureConfig& config, const FigureOptions& options = {});

/// The cells with title and labels.
/// @throws IoError if the font is missing
render::Image figure_sheet(const FigureConfig& config, const Figure& figure);

/// Name of a cell's files without extension, counting from 1: "row1-col2".
std::string cell_name(std::size_t row, std::size_t column);

/// Writes row<i>-col<j>.exr and .png for each cell, sheet.png and metrics.json, each aside and then renamed.
/// @throws IoError
void write_figure(const FigureConfig& config, const Figure& figure, const std::filesystem::path& folder);

/// All that was found, used and measured, as indented JSON.
std::string metrics_json(const FigureConfig& config, const Figure& figure);

}  // namespace automorph
