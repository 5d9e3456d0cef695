#include "render/image/image_file.h"

#include <unistd.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "morph/mesh/errors.h"
#include "render/image/image_module.h"
#include "tests/catch.h"
#include "tests/files.h"

using namespace automorph;
using namespace automorph::render;
namespace fs = std::filesystem;

namespace {

// A folder of its own for each test case, removed afterwards.
struct Folder {
    fs::path path = fs::temp_directory_path() / ("automorph-image-test-" + std::to_string(getpid()));
    Folder() { fs::create_directories(path); }
    ~Folder() { fs::remove_all(path); }
    std::ptrdiff_t file_count() const {
        return std::distance(fs::directory_iterator(path), fs::directory_iterator());
    }
};

Image noise(int width, int height, int channels) {
    Image image(width, height, channels);
    std::mt19937 random(1);
    for (float& x : image.pixels) x = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    return image;
}

// IEC 61966-2-1, independent of the library's table.
double srgb_encode(double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

}  // namespace

TEST_CASE("EXR keeps every bit, special values included, and the metadata") {
    const Folder folder;
    for (int channels : {1, 3}) {
        Image image = noise(37, 23, channels);  // any bit pattern: denormals, infinities, NaN
        const fs::path file = folder.path / "picture.exr";
        write_exr(file, image,
                  {{"Software", "automorph 1"}, {"spp", "64"}, {"seed", "18446744073709551615"}});
        const ImageFile read = read_image(file);
        CHECK(read.image.width == 37);
        CHECK(read.image.height == 23);
        REQUIRE(read.image.channels == channels);
        std::size_t different = 0;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            if (std::bit_cast<std::uint32_t>(image.pixels[i]) !=
                std::bit_cast<std::uint32_t>(read.image.pixels[i])) {
                ++different;
            }
        }
        CHECK(different == 0);
        CHECK(read.metadata.at("Software") == "automorph 1");
        CHECK(read.metadata.at("spp") == "64");
        CHECK(read.metadata.at("seed") == "18446744073709551615");
    }
    CHECK(folder.file_count() == 1);
}

TEST_CASE("equal pictures give equal files, at any time") {
    const Folder folder;
    const Image image(20, 10, 3, 0.3f);
    write_exr(folder.path / "a.exr", image, {{"spp", "1"}});
    write_png(folder.path / "a.png", image, {{"spp", "1"}});
    usleep(1100000);  // the files' dates would be written in seconds
    write_exr(folder.path / "b.exr", image, {{"spp", "1"}});
    write_png(folder.path / "b.png", image, {{"spp", "1"}});
    CHECK(content(folder.path / "a.exr") == content(folder.path / "b.exr"));
    CHECK(content(folder.path / "a.png") == content(folder.path / "b.png"));
}

TEST_CASE("PNG keeps all 8-bit codes, and the metadata") {
    const Folder folder;
    Image image(256, 2, 3);
    for (int x = 0; x < 256; ++x) {
        for (int y = 0; y < 2; ++y) {
            for (int c = 0; c < 3; ++c) {
                image.at(x, y)[c] = from_srgb8(static_cast<std::uint8_t>(c == 1 ? 255 - x : x));
            }
        }
    }
    write_png(folder.path / "p.png", image, {{"Software", "automorph 1"}, {"Comment", "as it should be"}});
    const ImageFile read = read_image(folder.path / "p.png");
    REQUIRE(read.image.pixels.size() == image.pixels.size());
    CHECK(read.image.pixels == image.pixels);
    CHECK(read.metadata.at("Software") == "automorph 1");
    CHECK(read.metadata.at("Comment") == "as it should be");
}

TEST_CASE("8-bit codes are the rounded sRGB curve, clamped") {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform;
    for (int i = 0; i < 20000; ++i) {
        const auto x = static_cast<float>(std::pow(uniform(random), 3.0));
        const double code = 255.0 * srgb_encode(x);
        if (std::abs(code - std::floor(code) - 0.5) < 1e-3) continue;  // the two formulas differ by 1e-5
        CHECK(to_srgb8(x) == std::lround(code));
    }
    CHECK(to_srgb8(-0.5f) == 0);
    CHECK(to_srgb8(0.0f) == 0);
    CHECK(to_srgb8(1.0f) == 255);
    CHECK(to_srgb8(7.0f) == 255);
    CHECK(to_srgb8(std::numeric_limits<float>::infinity()) == 255);
    CHECK(to_srgb8(-std::numeric_limits<float>::infinity()) == 0);
    CHECK(to_srgb8(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(to_srgb8(0.18f) == 118);  // middle grey
    for (int code = 0; code < 256; ++code) {
        CHECK(to_srgb8(from_srgb8(static_cast<std::uint8_t>(code))) == code);
    }
}

TEST_CASE("an EXR with layers keeps every value of each, and reads as its picture") {
    const Folder folder;
    const fs::path file = folder.path / "layers.exr";
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-5.0f, 5.0f);
    const auto values = [&](int channels) {
        Image image(7, 5, channels);
        for (float& x : image.pixels) x = uniform(random);
        return image;
    };
    Layers layers{values(3), values(3), values(3), values(1), values(3),
                  values(1), values(1), values(3), values(1)};
    layers.depth.pixels[3] = std::numeric_limits<float>::infinity();
    const Image image = values(3);
    write_exr(file, image, layers, {{"seed", "7"}});
    CHECK(read_image(file).image.pixels == image.pixels);
    CHECK(read_image(file).metadata.at("seed") == "7");
    const auto same = [&](const Image& layer, const std::vector<std::string>& names) {
        return read_channels(file, names).pixels == layer.pixels;
    };
    CHECK(same(layers.albedo, {"albedo.R", "albedo.G", "albedo.B"}));
    CHECK(same(layers.shading_normal, {"shading_normal.X", "shading_normal.Y", "shading_normal.Z"}));
    CHECK(same(layers.geometric_normal, {"geometric_normal.X", "geometric_normal.Y", "geometric_normal.Z"}));
    CHECK(same(layers.depth, {"depth.Z"}));
    CHECK(same(layers.position, {"position.X", "position.Y", "position.Z"}));
    CHECK(same(layers.object, {"object.id"}));
    CHECK(same(layers.face, {"face.id"}));
    CHECK(same(layers.variance, {"variance.R", "variance.G", "variance.B"}));
    CHECK(same(layers.samples, {"samples.count"}));
    CHECK_THROWS_AS(read_channels(file, {"nothing"}), IoError);
    layers.depth = Image(7, 4, 1);
    CHECK_THROWS_AS(write_exr(file, image, layers), IoError);
}

TEST_CASE("16-bit PNG is the sRGB curve in steps of 1 / 65535") {
    const Folder folder;
    const fs::path file = folder.path / "deep.png";
    Image image(300, 1, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = static_cast<float>(i) / static_cast<float>(image.pixels.size() - 1);
    write_png(file, image, {}, {ToneCurve::Srgb, 16});
    const Image read = read_image(file).image;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        REQUIRE(srgb_encode(static_cast<double>(read.pixels[i])) ==
                Approx(srgb_encode(static_cast<double>(image.pixels[i]))).margin(0.51 / 65535));
    CHECK(to_srgb16(1.0f) == 65535);
    CHECK(to_srgb16(0.0f) == 0);
    CHECK_THROWS_AS(write_png(file, image, {}, {ToneCurve::Srgb, 12}), IoError);
}

TEST_CASE("the filmic curve rises from 0 to 1 and rolls off") {
    CHECK(filmic(0.0f) == 0.0f);
    CHECK(filmic(-1.0f) == 0.0f);
    CHECK(filmic(0.18f) == Approx(0.2669).epsilon(1e-3));
    CHECK(filmic(1.0f) == Approx(0.8038).epsilon(1e-3));
    CHECK(filmic(1e9f) == 1.0f);
    CHECK(filmic(std::numeric_limits<float>::infinity()) == 1.0f);
    float before = -1.0f;
    for (float x = 0.0f; x < 4.0f; x += 0.01f) {
        CHECK(filmic(x) > before);
        before = filmic(x);
    }
    const Folder folder;
    const Image image(2, 2, 3, 1.0f);
    write_png(folder.path / "filmic.png", image, {}, {ToneCurve::Filmic, 8});
    CHECK(read_image(folder.path / "filmic.png").image.pixels[0] == Approx(0.8038).margin(0.01));
}

TEST_CASE("what cannot be written or read is an error that names the file, and leaves nothing behind") {
    const Folder folder;
    const Image image(4, 4);
    CHECK_THROWS_AS(write_exr(folder.path / "missing" / "a.exr", image), IoError);
    CHECK_THROWS_AS(write_png(folder.path / "missing" / "a.png", image), IoError);
    CHECK_THROWS_AS(write_png(folder.path / "a.nosuchformat", image), IoError);
    CHECK_THROWS_AS(write_png(folder.path / "a.png", Image(0, 4)), IoError);
    CHECK_THROWS_AS(write_png(folder.path / "a.png", Image(4, 4, 2)), IoError);
    fs::create_directories(folder.path / "taken.exr" / "in-the-way");
    CHECK_THROWS_AS(write_exr(folder.path / "taken.exr", image), IoError);
    CHECK(folder.file_count() == 1);

    CHECK_THROWS_AS(read_image(folder.path / "none.exr"), IoError);
    std::ofstream(folder.path / "text.png") << "not a picture";
    std::ofstream(folder.path / "empty.exr");
    CHECK_THROWS_AS(read_image(folder.path / "text.png"), IoError);
    CHECK_THROWS_AS(read_image(folder.path / "empty.exr"), IoError);
    write_exr(folder.path / "whole.exr", noise(64, 64, 3));
    const std::string whole = content(folder.path / "whole.exr");
    std::ofstream(folder.path / "half.exr", std::ios::binary) << whole.substr(0, whole.size() / 2);
    try {
        read_image(folder.path / "half.exr");
        FAIL("no error");
    } catch (const IoError& error) {
        CHECK(std::string(error.what()).find("half.exr") != std::string::npos);
    }
}

TEST_CASE("a module that is missing or none is an error that names the file and the reason") {
    const Folder folder;
    const auto message = [](const fs::path& file) {
        try {
            load_image_module(file.string());
        } catch (const IoError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const fs::path missing = folder.path / "image_io.so", text = folder.path / "text.so";
    CHECK(message(missing).find(missing.string() + ": ") == 0);
    CHECK(message(missing).find("no such file") != std::string::npos);
    std::ofstream(text) << "not a library";
    CHECK(message(text).find(text.string() + ": ") == 0);
}
