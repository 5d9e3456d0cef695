#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "render/figure/figure.h"

/// Which files of a figure's folder are the figure's: files.txt lists them, one name a line. Thus a run can
/// remove what an earlier one with other rows, columns or videos made, and nothing else.
namespace automorph {

using FileNames = std::set<std::string>;

/// Names of the files that a run writes; without videos if there is no ffmpeg.
FileNames figure_files(const FigureConfig& config, const FigureOptions& options);

/// Puts the names on the list, before the first of these files is written.
/// @throws IoError
void list_files(const std::filesystem::path& folder, const FileNames& names);

/// Those on the list that are there and not among `names`.
FileNames other_files(const std::filesystem::path& folder, const FileNames& names);

/// Removes files, which other_files() found, and takes them off the list.
/// @throws IoError
void remove_files(const std::filesystem::path& folder, const FileNames& names);

}  // namespace automorph
