#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "morph/report.h"
#include "render/camera/camera.h"
#include "render/figure/color_field.h"
#include "render/figure/config.h"
#include "render/figure/progress.h"
#include "render/figure/selection.h"
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
    bool denoise = false;       ///< every cell, as `picture.denoise` does
    std::string embree_config;  ///< "isa=sse4.2" makes the pictures the same on every x86-64 machine
    Selection rows, cells;      ///< those to picture; the camera stays that of the whole figure
    Selection frames;           ///< of the videos
    bool check_frames = true;   ///< measures the frames of each row's motion
    bool panels = true;         ///< fills Figure::panels
    Progress progress;
};

struct FigureCell {
    render::Image image;                   ///< linear RGB
    std::optional<render::Layers> layers;  ///< if asked for and the picture is as it was rendered
    std::string label;                     ///< what stands above it
    double alpha = 0;                      ///< of a morph's frame
    std::size_t column = 0;                ///< in the whole figure
    double seconds = 0;                    ///< of rendering
    std::uint64_t samples = 0, rays = 0, bad_samples = 0;
};

/// What a morph is made of, as small pictures for the page.
struct MorphPanels {
    std::vector<FigureCell> maps;  ///< source and target in turn, turned alike; of the sphere, front and back
    std::vector<FigureCell> features;  ///< source, target; empty unless features aligned the maps
};

/// How a row moves.
struct Motion {
    std::shared_ptr<const Morph> morph;  ///< rows with the same options share it; empty where none is shown
    Interpolation scheme = Interpolation::Slerp;

    Points at(double alpha) const { return morph->frame(alpha, scheme); }
    Points shading(double alpha) const { return morph->shading(alpha, scheme); }
};

/// A loop from the source to the target and back, as pictures for the page.
struct Clip {
    std::string name;                 ///< of the video files in the figure's folder, without extension
    int width = 0, height = 0;        ///< pixels
    int frames = 0;                   ///< of the video
    std::vector<double> alphas;       ///< of the stills, ascending
    std::vector<std::string> stills;  ///< one per alpha, as data URIs
    double seconds = 0;               ///< of rendering
    bool encoded = false;             ///< the videos are in the folder
    std::vector<std::string>
        films;  ///< those videos, as data URIs; empty where they are too large for a page
};

struct FigureRow {
    RowConfig config;
    std::size_t number = 0;  ///< in the whole figure
    std::size_t morph = 0;   ///< index into Figure::morphs
    std::vector<FigureCell> cells;
    std::vector<FrameReport> frames;    ///< along the motion; empty unless they were checked
    std::vector<std::string> warnings;  ///< what is suspicious about them, one sentence each
    Motion motion;
    std::vector<int> marked;   ///< vertices of the morph with a sphere
    std::optional<Clip> clip;  ///< of make_clips()
};

struct Figure {
    std::vector<Report> morphs;       ///< one per different set of options; rows share them
    std::vector<MorphPanels> panels;  ///< per morph; empty of those that no selected row shows
    std::vector<FigureRow> rows;
    std::vector<Motion> motions;      ///< of all rows, selected or not
    std::optional<Clip> turntable;    ///< without stills
    std::string no_videos;            ///< why there are none; empty otherwise
    std::string part;                 ///< what was selected, "rows 2, cells 1,3-4"; empty: the whole figure
    render::Camera camera;            ///< of all cells
    std::optional<ColorScale> scale;  ///< of `picture.color`, the same in all cells
    int width = 0, height = 0, spp = 0;
    double load_seconds = 0, morph_seconds = 0, check_seconds = 0, panel_seconds = 0, render_seconds = 0,
           video_seconds = 0;
};

/// Rows and columns of a figure's cells before anything is selected.
struct FigureGrid {
    std::size_t rows = 0, columns = 0;
};

FigureGrid figure_grid(const FigureConfig& config);

/// "rows 2, cells 1,3-4", as selected; empty if nothing was.
std::string part_text(const FigureOptions& options);

/// @throws ConfigError if a row, cell or frame is selected that the figure does not have
void check_selections(const FigureConfig& config, const FigureOptions& options);

/// Computes all cells; writes nothing.
/// @throws IoError, InvalidMesh, SolverFailure as load_mesh() and morph() do, ConfigError if an option is out
/// of range or nothing is selected
Figure render_figure(const FigureConfig& config, const FigureOptions& options = {});

/// The cells with title and labels.
/// @throws IoError if the font is missing
render::Image figure_sheet(const FigureConfig& config, const Figure& figure);

/// Name of a cell's files without extension, counting from 1: "row1-col2".
std::string cell_name(std::size_t row, std::size_t column);

/// Writes row<i>-col<j>.exr and .png for each cell, sheet.png, metrics.json and the page index.html, each
/// aside and then renamed.
/// @throws IoError
void write_figure(const FigureConfig& config, const Figure& figure, const std::filesystem::path& folder);

/// All that was found, used and measured, as indented JSON.
std::string metrics_json(const FigureConfig& config, const Figure& figure);

}  // namespace automorph
