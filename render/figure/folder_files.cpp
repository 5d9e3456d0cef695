#include "render/figure/folder_files.h"

#include <fstream>

#include "morph/mesh/write_file.h"
#include "render/figure/clips.h"
#include "render/video/video_encoder.h"

namespace automorph {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = "files.txt";

void write_list(const fs::path& folder, const FileNames& names) {
    std::string text = "# Made by 'automorph figure', which removes those that a later run does not make.\n";
    for (const std::string& name : names) text += name + "\n";
    write_file(folder / kList, text);
}

}  // namespace

FileNames figure_files(const FigureConfig& config, const FigureOptions& options) {
    FileNames names{"sheet.png", "metrics.json", "index.html", kList};
    const FigureGrid grid = figure_grid(config);
    for (std::size_t row = 0; row < grid.rows; ++row) {
        for (std::size_t column = 0; column < grid.columns; ++column) {
            if (!options.rows.has(row) || !options.cells.has(column)) continue;
            for (const char* extension : {".exr", ".png"}) names.insert(cell_name(row, column) + extension);
        }
    }
    if (!has_ffmpeg()) return names;
    for (const std::string& clip : clip_names(config, options)) {
        for (const fs::path& file : video_files({}, clip)) names.insert(file.string());
    }
    return names;
}

FileNames other_files(const fs::path& folder, const FileNames& names) {
    FileNames others;
    std::ifstream list(folder / kList);
    for (std::string name; std::getline(list, name);) {
        // A list that was changed must not lead out of the folder.
        if (name.find('/') != std::string::npos || names.count(name) > 0) continue;
        std::error_code error;
        if (fs::is_regular_file(fs::symlink_status(folder / name, error))) others.insert(name);
    }
    return others;
}

void list_files(const fs::path& folder, const FileNames& names) {
    FileNames all = other_files(folder, names);
    all.insert(names.begin(), names.end());
    write_list(folder, all);
}

void remove_files(const fs::path& folder, const FileNames& names) {
    for (const std::string& name : names) {
        std::error_code ignored;
        fs::remove(folder / name, ignored);
    }
    write_list(folder, other_files(folder, {}));
}

}  // namespace automorph
