#include "render/program/figure_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/figure/clips.h"
#include "render/program/figure_estimate.h"
#include "render/video/video_encoder.h"

namespace automorph::program {
namespace {

std::size_t selected(const Selection& selection, std::size_t count) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < count; ++i) number += selection.has(i);
    return number;
}

PictureCounts counts_of(const FigureConfig& config, const FigureOptions& options) {
    PictureCounts counts;
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

std::string duration(double seconds) {
    if (seconds < 90) return fmt::format("{:.0f} s", std::max(1.0, seconds));
    return fmt::format("{:.0f} min", seconds / 60);
}

/// "2 min (meshes 5 s, pictures 77 s)", without what takes no time.
std::string estimate_text(const Estimate& estimate) {
    std::string parts;
    for (const auto& [name, seconds] : {std::pair{"meshes", estimate.meshes},
                                        {"morphs", estimate.morphs},
                                        {"checks and maps", estimate.checks},
                                        {"pictures", estimate.pictures},
                                        {"videos", estimate.videos}}) {
        if (seconds > 0) parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", name, duration(seconds));
    }
    return fmt::format("{} ({})", duration(estimate.whole()), parts);
}

}  // namespace

std::string figure_plan(const FigureConfig& config, const FigureOptions& options,
                        const std::filesystem::path& folder) {
    const PictureCounts counts = counts_of(config, options);
    const double width = std::round(config.picture.width * options.scale),
                 height = std::round(config.picture.height * options.scale);
    const int spp = options.spp.value_or(config.picture.spp);
    const VideoSize video = video_size(config);
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
    text += "  estimate: " + estimate_text(estimate(config, options, counts)) + "\n";
    return text;
}

}  // namespace automorph::program
