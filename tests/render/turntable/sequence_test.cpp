#include "render/turntable/sequence.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "morph/mesh/errors.h"
#include "morph/shapes/shapes.h"
#include "render/image/image_file.h"
#include "tests/catch.h"
#include "tests/files.h"

using namespace automorph;
using namespace automorph::turntable;
namespace fs = std::filesystem;

namespace {

void put(const fs::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

render::Image ramp() {
    render::Image image(40, 30);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = 1.2f * static_cast<float>(i) / static_cast<float>(image.pixels.size()) - 0.1f;
    return image;
}

}  // namespace

TEST_CASE("a frame is finished if it is whole and made from the same inputs") {
    const TemporaryFolder folder;
    for (const char* name : {"f.png", "f.exr"}) {
        INFO(name);
        const fs::path file = folder / name;
        CHECK(frame_state(file, "{\"spp\":4}") == FrameState::Missing);
        write_frame(file, ramp(), "{\"spp\":4}");
        CHECK(frame_state(file, "{\"spp\":4}") == FrameState::Finished);
        CHECK(frame_state(file, "{\"spp\":5}") == FrameState::Outdated);
        const std::string bytes = content(file);
        write_frame(file, ramp(), "{\"spp\":4}");
        CHECK(content(file) == bytes);
        // Cut anywhere, it is redone.
        for (std::size_t length = 0; length < bytes.size(); length += 1 + bytes.size() / 60) {
            put(file, bytes.substr(0, length));
            CHECK(frame_state(file, "{\"spp\":4}") == FrameState::Damaged);
        }
        put(file, bytes.substr(0, bytes.size() - 1));
        CHECK(frame_state(file, "{\"spp\":4}") == FrameState::Damaged);
        render::Image changed = ramp();
        changed.pixels[100] += 0.1f;
        name == std::string("f.png") ? render::write_png(file, changed) : render::write_exr(file, changed);
        CHECK(frame_state(file, "{\"spp\":4}") == FrameState::Damaged);  // not ours
    }
}

TEST_CASE("pixels that changed after writing are noticed") {
    const TemporaryFolder folder;
    for (const char* name : {"f.png", "f.exr"}) {
        const fs::path file = folder / name;
        write_frame(file, ramp(), "x");
        render::ImageFile read = render::read_image(file);
        read.image.pixels[300] += 0.1f;
        name == std::string("f.png") ? render::write_png(file, read.image, read.metadata)
                                     : render::write_exr(file, read.image, read.metadata);
        CHECK(frame_state(file, "x") == FrameState::Damaged);
    }
}

TEST_CASE("frame ranges are read, and refused beyond the sequence") {
    CHECK(frame_range("", 10) == std::pair(0, 9));
    CHECK(frame_range("3-5", 10) == std::pair(3, 5));
    CHECK(frame_range("3-", 10) == std::pair(3, 9));
    CHECK(frame_range("7", 10) == std::pair(7, 7));
    CHECK(frame_range("0-9", 10) == std::pair(0, 9));
    for (const char* wrong : {"10", "5-3", "0-10", "-3", "a", "1-b", "1-2-3", "1.5", " 1", "1,2", "-"})
        CHECK_THROWS_AS(frame_range(wrong, 10), ConfigError);
}

TEST_CASE("only what is missing, damaged or outdated is made, and comes out the same") {
    const TemporaryFolder folder;
    const Mesh mesh = ellipsoid({1, 0.6, 0.4}, {.triangles = 200});
    TimelineOptions options;
    options.frames = 5;
    const std::vector<Exposure> frames = exposures(options);
    StageOptions picture;
    picture.width = picture.height = 24;
    picture.spp = 2;
    Sequence sequence;
    int version = 1;
    for (int i = 0; i < 5; ++i) sequence.files.push_back(folder / (std::to_string(i) + ".png"));
    sequence.last = 4;
    sequence.inputs = [&](int frame) { return std::to_string(version) + " " + std::to_string(frame); };
    Stage stage({mesh.F, [V = mesh.V](double) { return V; }}, frames, picture);

    std::vector<double> fractions;
    std::string detail;
    const Progress progress = [&](const std::string&, double fraction, const std::string& text) {
        fractions.push_back(fraction);
        if (!text.empty()) detail = text;
    };
    REQUIRE(open_frames(sequence).size() == 5);
    make_frames(stage, frames, sequence, open_frames(sequence), progress);
    CHECK(std::is_sorted(fractions.begin(), fractions.end()));
    CHECK(fractions.back() == 1);
    CHECK(std::count(fractions.begin(), fractions.end(), 1.0) == 1);
    CHECK(detail.find("frame 4 (5 of 5)") == 0);
    CHECK(open_frames(sequence).empty());

    std::vector<std::string> before;
    for (const fs::path& file : sequence.files) before.push_back(content(file));
    fs::remove(sequence.files[1]);
    fs::resize_file(sequence.files[3], before[3].size() / 2);
    const std::vector<OpenFrame> open = open_frames(sequence);
    REQUIRE(open.size() == 2);
    CHECK(open[0].frame == 1);
    CHECK(open[0].state == FrameState::Missing);
    CHECK(open[1].frame == 3);
    CHECK(open[1].state == FrameState::Damaged);
    make_frames(stage, frames, sequence, open, {});
    for (std::size_t i = 0; i < 5; ++i) CHECK(content(sequence.files[i]) == before[i]);

    version = 2;
    CHECK(open_frames(sequence).size() == 5);
    sequence.first = 2;
    CHECK(open_frames(sequence).size() == 3);
}
