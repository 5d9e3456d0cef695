#include "render/figure/figure.h"

#include <fstream>
#include <iterator>
#include <set>

#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/shapes/shapes.h"
#include "render/figure/frames.h"
#include "render/figure/mesh_source.h"
#include "render/figure/text_file.h"
#include "render/image/image_file.h"
#include "tests/catch.h"
#include "tests/render/temporary_folder.h"

using namespace automorph;
namespace fs = std::filesystem;

namespace {

const std::string kTiny = R"(title: Tiny
source: {shape: ellipsoid, semi_axes: [1, 0.8, 0.5], triangles: 300, seed: 3}
target: {shape: star, triangles: 400, rotation: {axis: [1, 0, 0], degrees: 40}, translation: [0.2, 0, 0]}
rows:
  - {label: plain, alignment: none, interpolation: linear}
  - {label: registered, interpolation: linear}
  - {label: turning, interpolation: slerp}
alphas: [0, 1/2, 1]
picture: {width: 40, height: 32, spp: 2}
)";

std::string content(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::set<std::string> names_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
    return names;
}

}  // namespace

TEST_CASE("rows with the same options share one morph, and each row has all its cells") {
    const Figure figure = render_figure(parse_config(kTiny, "tiny.yaml"));
    REQUIRE(figure.rows.size() == 3);
    CHECK(figure.morphs.size() == 2);
    CHECK(figure.rows[0].morph == 0);
    CHECK(figure.rows[1].morph == 1);
    CHECK(figure.rows[2].morph == 1);
    CHECK_FALSE(figure.morphs[0].registration.used);
    CHECK(figure.morphs[1].registration.used);
    for (const FigureRow& row : figure.rows) {
        REQUIRE(row.cells.size() == 3);
        for (const FigureCell& cell : row.cells) {
            CHECK(cell.image.width == 40);
            CHECK(cell.image.height == 32);
            CHECK(cell.bad_samples == 0);
            // Something is there.
            float darkest = 1;
            for (const float value : cell.image.pixels) darkest = std::min(darkest, value);
            CHECK(darkest < 0.8f);
        }
    }
    // The first and the last column show the same shapes in every row, up to how they are tessellated.
    for (const std::size_t column : {std::size_t{0}, std::size_t{2}}) {
        double mean[2] = {0, 0};
        for (const std::size_t row : {std::size_t{0}, std::size_t{1}}) {
            const render::Image& image = figure.rows[row].cells[column].image;
            for (const float value : image.pixels)
                mean[row] += value / static_cast<double>(image.pixels.size());
        }
        CHECK(mean[0] == Approx(mean[1]).epsilon(0.01));
    }
}

TEST_CASE("the background of a figure is even and meets the white paper of the sheet exactly") {
    FigureConfig config = parse_config(kTiny, "tiny.yaml");
    config.rows.resize(1);
    config.picture.ground = render::Ground::None;
    const Figure figure = render_figure(config);
    for (const FigureCell& cell : figure.rows[0].cells) {
        for (const int x : {0, 39}) {
            for (const int y : {0, 31}) {
                for (int channel = 0; channel < 3; ++channel) CHECK(cell.image.at(x, y)[channel] == 1.0f);
            }
        }
    }
}

TEST_CASE("a figure has the same bits for any number of threads") {
    const FigureConfig config = parse_config(kTiny, "tiny.yaml");
    FigureOptions one, three;
    one.threads = 1;
    three.threads = 3;
    const Figure a = render_figure(config, one), b = render_figure(config, three);
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
        for (std::size_t j = 0; j < a.rows[i].cells.size(); ++j) {
            CHECK(a.rows[i].cells[j].image.pixels == b.rows[i].cells[j].image.pixels);
        }
    }
}

TEST_CASE("samples and size can be overridden, and progress reaches the end of every task") {
    FigureOptions options;
    options.spp = 1;
    options.scale = 0.5;
    std::set<std::string> begun, ended;
    options.progress = [&](const std::string& task, double fraction) {
        begun.insert(task);
        if (fraction >= 1) CHECK(ended.insert(task).second);
    };
    const Figure figure = render_figure(parse_config(kTiny, "tiny.yaml"), options);
    CHECK(figure.width == 20);
    CHECK(figure.height == 16);
    CHECK(figure.spp == 1);
    CHECK(begun.size() == 6);  // meshes, two morphs, three rows
    CHECK(begun == ended);
    options.spp = 0;
    CHECK_THROWS_AS(render_figure(parse_config(kTiny, "tiny.yaml"), options), ConfigError);
}

TEST_CASE("a written figure has every cell, the sheet and the metrics, and nothing half-written") {
    const TemporaryFolder folder;
    const FigureConfig config = parse_config(kTiny, "tiny.yaml");
    const Figure figure = render_figure(config);
    write_figure(config, figure, folder / "deep/out");
    std::set<std::string> expected{"sheet.png", "metrics.json"};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            expected.insert(cell_name(i, j) + ".exr");
            expected.insert(cell_name(i, j) + ".png");
        }
    }
    CHECK(expected.count("row2-col3.exr") == 1);
    CHECK(names_in(folder / "deep/out") == expected);

    const render::ImageFile cell = render::read_image(folder / "deep/out/row2-col3.exr");
    CHECK(cell.image.pixels == figure.rows[1].cells[2].image.pixels);
    CHECK(cell.metadata.at("row") == "registered");
    const render::Image sheet = render::read_image(folder / "deep/out/sheet.png").image;
    CHECK(sheet.width > 3 * 40);
    const std::string metrics = content(folder / "deep/out/metrics.json");
    for (const char* phrase : {"\"label\": \"turning\"", "\"interpolation\": \"slerp\"", "\"rotation\"",
                               "\"seconds\"", "\"config_text\"", "\"bad_samples\": 0"}) {
        INFO(phrase);
        CHECK(metrics.find(phrase) != std::string::npos);
    }
}

TEST_CASE("a frame sequence is the morph's own frames") {
    const InputMesh a = admit_mesh(ellipsoid({1, 1, 0.6}, {.triangles = 200}), "a");
    const InputMesh b = admit_mesh(star({}, {.triangles = 300}), "b");
    const Morph m = morph(a, b);
    const FrameSequence sequence = frames_of(m, {0, 0.3, 1}, Interpolation::Slerp);
    REQUIRE(sequence.frames.size() == 3);
    CHECK(sequence.triangles == m.triangles());
    CHECK(sequence.frames[0] == m.endpoints().a);
    CHECK(sequence.frames[1] == m.frame(0.3, Interpolation::Slerp));
    CHECK(sequence.frames[2] == m.endpoints().b);
}

TEST_CASE("a mesh file is placed like a shape of the same pose") {
    const TemporaryFolder folder;
    MeshConfig shape;
    shape.shape = MeshConfig::Shape::Ellipsoid;
    shape.semi_axes = {1, 2, 3};
    shape.triangles = 200;
    MeshConfig file;
    file.file = folder / "shape.off";
    file.fit = false;
    write_mesh(file.file, make_mesh(shape, "shape").mesh);
    for (MeshConfig* config : {&shape, &file}) {
        config->rotation = {{0, 0, 2}, 90};
        config->scale = 2;
        config->translation = {10, 0, -1};
    }
    const Points from_shape = make_mesh(shape, "shape").mesh.V, from_file = make_mesh(file, "file").mesh.V;
    REQUIRE(from_shape.rows() == from_file.rows());
    CHECK((from_shape - from_file).cwiseAbs().maxCoeff() < 1e-12);
    // A quarter turn about z brings x to y: extents 2 * (2, 1, 3) about (10, 0, -1).
    CHECK((from_file.rowwise() - Eigen::RowVector3d(10, 0, -1))
              .cwiseAbs()
              .colwise()
              .maxCoeff()
              .isApprox(Eigen::RowVector3d(4, 2, 6), 0.1));
    CHECK((from_file.rowwise() - Eigen::RowVector3d(10, 0, -1)).col(2).maxCoeff() > 5);
}

TEST_CASE("files of any unit and place are fitted to one size about the origin") {
    const TemporaryFolder folder;
    MeshConfig config;
    config.file = folder / "sphere.off";
    for (const double size : {0.001, 1.0, 1000.0}) {
        write_mesh(config.file,
                   ellipsoid({size, size, size}, {.triangles = 2000, .translation = {5 * size, 0, size}}));
        const Points V = make_mesh(config, "").mesh.V;
        CHECK(V.rowwise().norm().minCoeff() == Approx(1).epsilon(0.02));
        CHECK(V.rowwise().norm().maxCoeff() == Approx(1).epsilon(0.02));
    }
}

TEST_CASE("text files are written whole or not at all") {
    const TemporaryFolder folder;
    write_text_file(folder / "a.txt", "first");
    write_text_file(folder / "a.txt", "second");
    CHECK(content(folder / "a.txt") == "second");
    CHECK(names_in(folder.path()) == std::set<std::string>{"a.txt"});

    CHECK_THROWS_AS(write_text_file(folder / "no/such/folder/a.txt", "x"), IoError);
    fs::create_directories(folder / "taken/inside");
    CHECK_THROWS_AS(write_text_file(folder / "taken", "x"), IoError);
    CHECK(names_in(folder.path()) == std::set<std::string>{"a.txt", "taken"});
    if (fs::exists("/dev/full")) {
        fs::create_symlink("/dev/full", folder / ("full." + std::to_string(::getpid()) + ".part"));
        CHECK_THROWS_AS(write_text_file(folder / "full", "does not fit"), IoError);
        CHECK_FALSE(fs::exists(folder / "full"));
    }
}

TEST_CASE("an output folder that cannot be is an IoError that names it") {
    const TemporaryFolder folder;
    write_text_file(folder / "file", "x");
    CHECK_NOTHROW(make_folder(folder / "a/b/c"));
    CHECK(fs::is_directory(folder / "a/b/c"));
    CHECK_NOTHROW(make_folder(folder / "a/b/c"));
    for (const fs::path& wrong : {folder / "file", folder / "file/below"}) {
        try {
            make_folder(wrong);
            FAIL("no error for " << wrong);
        } catch (const IoError& error) {
            CHECK(std::string(error.what()).rfind(wrong.string() + ": ", 0) == 0);
        }
    }
}
