#include "render/video/video_encoder.h"

#include <filesystem>
#include <fstream>
#include <set>

#include "morph/mesh/errors.h"
#include "tests/catch.h"
#include "tests/files.h"
#include "tests/render/video/programs.h"

using namespace automorph;
namespace fs = std::filesystem;

namespace {

VideoFrame plain_frame(int width, int height, std::uint8_t gray) {
    return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height), gray)};
}

}  // namespace

TEST_CASE("an encoder that gives up is an error with its reason, and leaves nothing behind") {
    const TemporaryFolder folder;
    const fs::path programs = folder / "programs", videos = folder / "videos";
    fs::create_directories(programs);
    fs::create_directories(videos);
    std::ofstream(programs / "ffmpeg") << "#!/bin/sh\necho 'no such codec' >&2\nexit 1\n";
    fs::permissions(programs / "ffmpeg", fs::perms::owner_all);
    const PathOnly fake(programs);
    try {
        VideoEncoder encoder({videos / "v.mp4", videos / "v.webm"}, 64, 64, 10);
        for (int i = 0; i < 100; ++i) encoder.add(plain_frame(64, 64, 0));
        encoder.finish();
        FAIL("no error");
    } catch (const IoError& error) {
        CHECK(std::string(error.what()) ==
              (videos / "v.mp4").string() + ": ffmpeg cannot make the video: no such codec");
    }
    CHECK(names_in(videos).empty());
}

TEST_CASE("one file or two, by their extensions, with even sides; the same again gives the same bytes") {
    if (!has_ffmpeg()) {
        WARN("skipped: ffmpeg is not installed");
        return;
    }
    const TemporaryFolder folder;
    for (const char* name : {"a", "b"}) {
        const std::string stem = name;
        VideoEncoder encoder({folder / (stem + ".webm"), folder / (stem + ".mp4")}, 35, 23, 10);
        for (int i = 0; i < 5; ++i) encoder.add(plain_frame(35, 23, static_cast<std::uint8_t>(40 * i)));
        encoder.finish();
    }
    VideoEncoder alone({folder / "alone.mp4"}, 35, 23, 10);
    for (int i = 0; i < 5; ++i) alone.add(plain_frame(35, 23, static_cast<std::uint8_t>(40 * i)));
    alone.finish();
    CHECK(names_in(folder.path()) ==
          std::set<std::string>{"a.mp4", "a.webm", "alone.mp4", "b.mp4", "b.webm"});
    CHECK(content(folder / "a.mp4") == content(folder / "b.mp4"));
    CHECK(content(folder / "a.webm") == content(folder / "b.webm"));
    CHECK(content(folder / "a.mp4") == content(folder / "alone.mp4"));
    CHECK(probed(folder / "a.mp4") == "h264,36,24,yuv420p,5\n");
    CHECK(probed(folder / "a.webm") == "vp9,36,24,yuv420p,5\n");
}

TEST_CASE("a video that is not finished leaves nothing behind") {
    if (!has_ffmpeg()) return;
    const TemporaryFolder folder;
    {
        VideoEncoder encoder({folder / "v.mp4", folder / "v.webm"}, 64, 64, 10);
        encoder.add(plain_frame(64, 64, 200));
    }
    CHECK(names_in(folder.path()).empty());
}
