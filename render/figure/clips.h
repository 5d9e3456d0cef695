#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "render/figure/config.h"
#include "render/figure/figure.h"

/// The films of a figure: each row's morph, there and back without a seam, and one row on a turntable.
namespace automorph {

/// Size of the videos: `video.size` along the longer side of a cell, both sides even.
struct VideoSize {
    int width = 0, height = 0;
};
VideoSize video_size(const FigureConfig& config);

/// Whether the selected rows and frames make films: one of each row's morph, one of the row that turns.
bool has_row_clips(const FigureConfig& config, const FigureOptions& options);
bool has_turntable(const FigureConfig& config, const FigureOptions& options);

/// These by name: "row1", "turntable".
std::vector<std::string> clip_names(const FigureConfig& config, const FigureOptions& options);

/// Browsers and editors play one or the other: NAME.mp4, NAME.webm.
std::vector<std::filesystem::path> video_files(const std::filesystem::path& folder, const std::string& name);

/// Renders each row's loop and the turntable, fills in FigureRow::clip and Figure::turntable and, where
/// ffmpeg is installed, writes row<i>.mp4, turntable.mp4 and both as .webm; Figure::no_videos says why not.
/// Figures that show no morph have none.
/// @throws IoError a file cannot be written, or ffmpeg gives up; nothing half-written is left
void make_clips(const FigureConfig& config, const FigureOptions& options, const std::filesystem::path& folder,
                Figure& figure);

}  // namespace automorph
