#include "render/figure/clips.h"

#include <algorithm>
#include <fstream>
#include <set>

#include "morph/mesh/errors.h"
#include "render/image/image_file.h"
#include "render/video/video_encoder.h"
#include "tests/catch.h"
#include "tests/files.h"
#include "tests/render/video/programs.h"

using namespace automorph;
namespace fs = std::filesystem;

namespace {

const std::string kTinyClips = R"(title: Tiny
source: {shape: ellipsoid, semi_axes: [1, 0.8, 0.5], triangles: 200, seed: 3}
target: {shape: star, triangles: 300}
rows:
  - {label: plain, alignment: none, interpolation: linear}
  - {label: other, alignment: none}
alphas: [0, 1]
picture: {width: 40, height: 30, spp: 1}
video: {frames: 6, size: 32, spp: 2, turntable: 4}
)";

/// A page's picture again.
render::Image decoded(const std::string& uri, const fs::path& folder) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    unsigned int buffer = 0;
    int bits = 0;
    for (std::size_t i = uri.find(',') + 1; i < uri.size() && uri[i] != '='; ++i) {
        buffer = (buffer << 6U) | static_cast<unsigned int>(digits.find(uri[i]));
        bits += 6;
        if (bits >= 8)
            bytes.push_back(static_cast<char>((buffer >> static_cast<unsigned int>(bits -= 8)) & 0xffU));
    }
    std::ofstream(folder / "still.jpg", std::ios::binary) << bytes;
    return render::read_image(folder / "still.jpg").image;
}

/// Mean difference of a pixel's largest and smallest channel.
double chroma(const render::Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        const auto [least, most] = std::minmax({image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
        sum += static_cast<double>(most - least);
    }
    return 3 * sum / static_cast<double>(image.pixels.size());
}

}  // namespace

TEST_CASE("videos have the cells' shape, with even sides") {
    FigureConfig config = parse_config(kTinyClips, "tiny.yaml");
    CHECK(video_size(config).width == 32);
    CHECK(video_size(config).height == 24);
    config.video.size = 33;
    CHECK(video_size(config).width % 2 == 0);
    CHECK(video_size(config).height % 2 == 0);
}

TEST_CASE("each row has a video, one row turns, and half of a loop's frames are rendered") {
    if (!has_ffmpeg()) {
        WARN("skipped: ffmpeg is not installed");
        return;
    }
    const TemporaryFolder folder;
    const FigureConfig config = parse_config(kTinyClips, "tiny.yaml");
    Figure figure = render_figure(config);
    make_clips(config, {}, folder.path(), figure);
    CHECK(figure.no_videos.empty());
    CHECK(names_in(folder.path()) == std::set<std::string>{"row1.mp4", "row1.webm", "row2.mp4", "row2.webm",
                                                           "turntable.mp4", "turntable.webm"});
    CHECK(probed(folder / "row1.mp4") == "h264,32,24,yuv420p,6\n");
    CHECK(probed(folder / "row2.webm") == "vp9,32,24,yuv420p,6\n");
    CHECK(probed(folder / "turntable.mp4") == "h264,32,24,yuv420p,4\n");
    // What a player needs first comes first.
    const std::string mp4 = content(folder / "row1.mp4");
    CHECK(mp4.find("moov") < mp4.find("mdat"));
    for (const FigureRow& row : figure.rows) {
        REQUIRE(row.clip);
        CHECK(row.clip->alphas.size() == 4);
        CHECK(row.clip->stills.size() == 4);
        CHECK(row.clip->alphas.front() == 0.0);
        CHECK(row.clip->alphas.back() == Approx(1.0));
        CHECK(row.clip->stills.front() != row.clip->stills.back());
        CHECK(row.clip->stills.front().rfind("data:image/jpeg;base64,", 0) == 0);
    }

    // The same again gives the same files; a part of the rows and frames, the same pictures.
    const TemporaryFolder other;
    FigureOptions options;
    options.rows = Selection("2");
    options.frames = Selection("2-3");
    options.threads = 1;
    Figure part = render_figure(config, options);
    make_clips(config, options, other.path(), part);
    CHECK(probed(other / "row2.mp4") == "h264,32,24,yuv420p,2\n");
    REQUIRE(part.rows.size() == 1);
    REQUIRE(part.rows[0].clip->stills.size() == 2);
    CHECK(part.rows[0].clip->stills[0] == figure.rows[1].clip->stills[1]);
    CHECK(part.rows[0].clip->stills[1] == figure.rows[1].clip->stills[2]);
    make_clips(config, {}, other.path(), part);
    CHECK(content(other / "row2.mp4") == content(folder / "row2.mp4"));
    CHECK(content(other / "row2.webm") == content(folder / "row2.webm"));
    options.frames = Selection("7");
    CHECK_THROWS_AS(render_figure(config, options), ConfigError);

    // A shutter that is never open blurs nothing, to the last bit; one that is, all that moves.
    for (const bool open : {false, true}) {
        const FigureConfig again =
            parse_config(kTinyClips, "tiny.yaml", {open ? "video.shutter=0.5" : "video.shutter=0"});
        make_clips(again, {}, other.path(), figure);
        CHECK((content(other / "turntable.mp4") == content(folder / "turntable.mp4")) == !open);
        CHECK((content(other / "row2.mp4") == content(folder / "row2.mp4")) == !open);
        CHECK(figure.rows[1].clip->stills.size() == 4);
    }
}

TEST_CASE("clips are coloured and marked as the cells are", "[sweep]") {
    const TemporaryFolder folder;
    const std::vector<std::string> still = {
        "video.turntable=0", "video.frames=2",    "picture.ground=none", "picture.albedo=[0.6, 0.6, 0.6]",
        "picture.width=32",  "picture.height=24", "picture.spp=32",      "video.spp=32"};
    const auto clip_chroma = [&](const std::vector<std::string>& more) {
        std::vector<std::string> overrides = still;
        overrides.insert(overrides.end(), more.begin(), more.end());
        const FigureConfig config = parse_config(kTinyClips, "tiny.yaml", overrides);
        Figure figure = render_figure(config);
        make_clips(config, {}, folder / "out", figure);
        std::vector<double> result;
        for (const std::size_t i : {std::size_t{0}, std::size_t{1}}) {
            const std::vector<std::string>& stills = figure.rows[0].clip->stills;
            REQUIRE(stills.size() == 2);
            result.push_back(chroma(decoded(stills[i], folder.path())));
            const std::string cell = render::jpeg_data_uri(figure.rows[0].cells[i].image, 85);
            result.push_back(chroma(decoded(cell, folder.path())));
        }
        return result;  // of still and cell at alpha = 0, then at 1
    };
    const std::vector<double> plain = clip_chroma({});
    for (const char* field : {"curvature", "displacement", "distortion"}) {
        INFO(field);
        const std::vector<double> colored = clip_chroma({std::string("picture.color=") + field});
        for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
            CHECK(colored[i] > 5 * plain[i]);
            CHECK(colored[i] == Approx(colored[i + 1]).epsilon(0.2));  // the cell beside it
        }
    }
    const std::vector<double> marked =
        clip_chroma({"picture.markers={kind: spread, count: 8, radius: 0.06}"});
    for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
        CHECK(marked[i] > 2 * plain[i]);
        CHECK(marked[i] == Approx(marked[i + 1]).epsilon(0.3));
    }
}

TEST_CASE("a turntable is coloured as the cells are", "[sweep]") {
    if (!has_ffmpeg()) {
        WARN("skipped: ffmpeg is not installed");
        return;
    }
    const TemporaryFolder folder;
    const auto first_frame = [&](const std::vector<std::string>& overrides) {
        const FigureConfig config = parse_config(kTinyClips, "tiny.yaml", overrides);
        Figure figure = render_figure(config);
        make_clips(config, {}, folder.path(), figure);
        const std::string command = "ffmpeg -v error -y -i '" + (folder / "turntable.mp4").string() +
                                    "' -frames:v 1 '" + (folder / "frame.png").string() + "'";
        REQUIRE(std::system(command.c_str()) == 0);
        return chroma(render::read_image(folder / "frame.png").image);
    };
    const std::string gray = "picture.albedo=[0.6, 0.6, 0.6]";
    CHECK(first_frame({gray, "picture.color=displacement"}) > 5 * first_frame({gray}));
}

TEST_CASE("without ffmpeg there are stills but no videos, and the reason is told") {
    const TemporaryFolder folder;
    const FigureConfig config = parse_config(kTinyClips, "tiny.yaml");
    Figure figure = render_figure(config);
    const PathOnly none(folder.path());
    CHECK_FALSE(has_ffmpeg());
    make_clips(config, {}, folder / "out", figure);
    CHECK(figure.no_videos.find("Debian package ffmpeg") != std::string::npos);
    CHECK(names_in(folder / "out").empty());
    CHECK_FALSE(figure.turntable);
    REQUIRE(figure.rows[0].clip);
    CHECK(figure.rows[0].clip->stills.size() == 4);
    CHECK_FALSE(figure.rows[0].clip->encoded);
    CHECK_THROWS_AS(VideoEncoder({folder / "v.mp4"}, 16, 16, 10), IoError);
    CHECK(names_in(folder.path()) == std::set<std::string>{"out"});
}
