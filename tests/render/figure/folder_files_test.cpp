#include "render/figure/folder_files.h"

#include <filesystem>
#include <fstream>

#include "render/figure/clips.h"
#include "render/video/video_encoder.h"
#include "tests/catch.h"
#include "tests/files.h"
#include "tests/render/video/programs.h"

using namespace automorph;
namespace fs = std::filesystem;

namespace {

const FileNames kAlways{"files.txt", "index.html", "metrics.json", "sheet.png"};

FileNames always_and(FileNames others) {
    others.insert(kAlways.begin(), kAlways.end());
    return others;
}

void touch(const fs::path& file) {
    std::ofstream(file) << "x";
}

FigureConfig config_of_two_rows() {
    return parse_config(
        "source: {shape: star}\ntarget: {shape: ellipsoid}\nrows: [{label: a}, {label: b}]\n"
        "alphas: [0, 1]\nvideo: {frames: 4, turntable: 8, turntable_row: 1}\n",
        "x.yaml");
}

}  // namespace

TEST_CASE("what a figure writes follows from the selected rows, cells and frames, and from ffmpeg") {
    const TemporaryFolder folder;
    touch(folder / "ffmpeg");
    fs::permissions(folder / "ffmpeg", fs::perms::owner_all);
    const FigureConfig config = config_of_two_rows();
    FigureOptions options;
    {
        const PathOnly none("/nonexistent");
        CHECK(figure_files(config, options) ==
              always_and({"row1-col1.exr", "row1-col1.png", "row1-col2.exr", "row1-col2.png", "row2-col1.exr",
                          "row2-col1.png", "row2-col2.exr", "row2-col2.png"}));
    }
    const PathOnly fake(folder.path());
    options.cells = Selection("2");
    options.rows = Selection("2");
    CHECK(figure_files(config, options) ==
          always_and({"row2-col2.exr", "row2-col2.png", "row2.mp4", "row2.webm"}));
    CHECK(clip_names(config, options) == std::vector<std::string>{"row2"});
    options.rows = Selection("1");
    CHECK(clip_names(config, options) == std::vector<std::string>{"row1", "turntable"});
    // Frames that only the turntable has.
    options.frames = Selection("5-8");
    CHECK(clip_names(config, options) == std::vector<std::string>{"turntable"});
    FigureConfig drawn = parse_config("show: map\nsource: {shape: star}\n", "y.yaml");
    CHECK(figure_files(drawn, {}) ==
          always_and({"row1-col1.exr", "row1-col1.png", "row1-col2.exr", "row1-col2.png"}));
}

TEST_CASE("files of earlier runs are told from those of others by the list, which no name leads out of") {
    const TemporaryFolder folder;
    const fs::path made = folder / "made";
    fs::create_directories(made / "folder.png");
    CHECK(other_files(made, {}).empty());
    list_files(made, {"a.png", "b.png", "gone.png", "folder.png", "files.txt"});
    for (const char* name : {"a.png", "b.png", "mine.png"}) touch(made / name);
    touch(folder / "outside.png");
    fs::create_symlink(folder / "outside.png", made / "link.png");
    std::ofstream(made / "files.txt", std::ios::app)
        << "../outside.png\n"
        << (folder / "outside.png").string() << "\nlink.png\n..\n.\n\n";
    CHECK(other_files(made, {"b.png", "files.txt"}) == FileNames{"a.png"});

    // What is to be made now is listed beside what was made before.
    list_files(made, {"b.png", "c.png", "files.txt"});
    touch(made / "c.png");
    CHECK(other_files(made, {"files.txt"}) == FileNames{"a.png", "b.png", "c.png"});
    remove_files(made, {"a.png"});
    CHECK(names_in(made) ==
          std::set<std::string>{"b.png", "c.png", "files.txt", "folder.png", "link.png", "mine.png"});
    CHECK(other_files(made, {}) == FileNames{"b.png", "c.png", "files.txt"});
    CHECK(fs::exists(folder / "outside.png"));
}
