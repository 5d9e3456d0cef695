#include "render/program/figure_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "morph/shapes/shapes.h"
#include "render/figure/clips.h"
#include "render/figure/mesh_source.h"
#include "render/figure/subject.h"
#include "render/video/video_encoder.h"

namespace automorph::program {
namespace {

/// Rows, columns and frames that will be made.
struct Counts {
    std::size_t rows = 0, columns = 0;
    int stills = 0;     ///< frames rendered per row's video; the way back shows them again
    int turntable = 0;  ///< frames
};

std::size_t selected(const Selection& selection, std::size_t count) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i) number += selection.has(i);
    return number;
}

Counts counts_of(const FigureConfig& config, const FigureOptions& options) {
    Counts counts;
    const bool morphs = config.show == Show::Morph;
    const FigureGrid grid = figure_grid(config);
    check_selections(config, options);
    counts.rows = selected(options.rows, grid.rows);
    counts.columns = selected(options.cells, grid.columns);
    if (!morphs) return counts;
    std::vector<bool> needed(static_cast<std::size_t>(config.video.frames / 2 + 1), false);
    for (int i = 0; i < config.video.frames; ++i) {
        if (options.frames.has(static_cast<std::size_t>(i)))
            needed[static_cast<std::size_t>(std::min(i, config.video.frames - i))] = true;
    }
    counts.stills = static_cast<int>(std::count(needed.begin(), needed.end(), true));
    if (has_ffmpeg() && has_turntable(config, options)) {
        counts.turntable =
            static_cast<int>(selected(options.frames, static_cast<std::size_t>(config.video.turntable)));
    }
    return counts;
}

/// Paths per second on this machine: an ellipsoid in the figure's light, for a fraction of a second.
double paths_per_second(const FigureConfig& config, const FigureOptions& options) {
    constexpr int kSize = 128, kSpp = 16;
    ShapeOptions shape;
    shape.triangles = 20000;
    const Mesh mesh = ellipsoid({1, 0.8, 0.6}, shape);
    FigureOptions quiet = options;
    quiet.progress = {};
    const Shooting shooting = shooting_of(config.picture, quiet, {kSize, kSize, kSpp}, {&mesh.V});
    Subject subject(shooting, mesh.V, mesh.F);
    const FigureCell cell = subject.shoot(mesh.V, {});
    return kSize * kSize * kSpp / std::max(cell.seconds, 1e-3);
}

/// Seconds per thousand triangles of both shapes, on one core of 2020; a rule of thumb.
double morph_seconds(const RowConfig& row, double thousands) {
    switch (row.alignment) {
        case Alignment::None:
            return 0.01 * thousands;
        case Alignment::Registration:
        case Alignment::Features:
            return 2.0 + 0.03 * thousands;
        case Alignment::Dense:
            return 3.0 + 0.3 * thousands;
    }
    return 0;
}

/// Of a shape as asked for, of a file as it is.
double triangle_count(const MeshConfig& mesh, const std::string& name) {
    return mesh.file.empty() ? mesh.triangles : make_mesh(mesh, name).mesh.triangle_count();
}

std::string duration(double seconds) {
    if (seconds < 90) return fmt::format("{:.0f} s", std::max(1.0, seconds));
    return fmt::format("{:.0f} min", seconds / 60);
}

}  // namespace

std::string figure_plan(const FigureConfig& config, const FigureOptions& options,
                        const std::filesystem::path& folder) {
    const Counts counts = counts_of(config, options);
    const double width = std::round(config.picture.width * options.scale),
                 height = std::round(config.picture.height * options.scale);
    const int spp = options.spp.value_or(config.picture.spp);
    const VideoSize video = video_size(config);
    const double rate = paths_per_second(config, options);
    const double cells = width * height * spp * static_cast<double>(counts.rows * counts.columns) / rate;
    // Adaptive sampling spares about half of a video's paths.
    constexpr double kTaken = 0.5;
    const int frames = counts.stills * static_cast<int>(counts.rows) + counts.turntable;
    const double films = kTaken * video.width * video.height * config.video.spp * frames / rate;
    double thousands = triangle_count(config.source, "source") / 1000;
    if (!config.rows.empty()) thousands += triangle_count(config.target, "target") / 1000;
    double morphs = 0;
    for (const RowConfig& row : config.rows) morphs += morph_seconds(row, thousands);

    std::string text = fmt::format("{}: would make in {}\n", config.file.string(), folder.string());
    text += fmt::format("  {} x {} cells of {} x {} pixels, {} paths each: EXR, PNG, sheet.png\n",
                        counts.rows, counts.columns, width, height, spp);
    if (counts.stills > 0) {
        text += fmt::format("  {} video{} of {} frames ({} of them rendered), {} x {} pixels, {} paths\n",
                            counts.rows, counts.rows == 1 ? "" : "s",
                            selected(options.frames, static_cast<std::size_t>(config.video.frames)),
                            counts.stills, video.width, video.height, config.video.spp);
    }
    if (counts.turntable > 0) text += fmt::format("  a turntable of {} frames\n", counts.turntable);
    if (config.show == Show::Morph && !has_ffmpeg())
        text += "  no video files: the program ffmpeg is not installed (Debian package ffmpeg)\n";
    text += "  index.html, metrics.json\n";
    text += fmt::format("  estimate: {} (morphs {}, pictures {}, videos {})\n",
                        duration(morphs + cells + films), duration(morphs), duration(cells), duration(films));
    return text;
}

}  // namespace automorph::program
