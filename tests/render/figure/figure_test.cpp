#include "render/figure/figure.h"

#include <nlohmann/json.hpp>
#include <set>

#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/mesh/write_file.h"
#include "morph/shapes/shapes.h"
#include "render/figure/frames.h"
#include "render/figure/mesh_source.h"
#include "render/figure/page.h"
#include "render/image/image_file.h"
#include "tests/catch.h"
#include "tests/files.h"

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

TEST_CASE("a figure has the same bits for any number of threads", "[sweep]") {
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
    CHECK(begun.size() == 8);  // meshes, two morphs, their frames, their panels, three rows
    CHECK(begun == ended);
    options.spp = 0;
    CHECK_THROWS_AS(render_figure(parse_config(kTiny, "tiny.yaml"), options), ConfigError);
}

TEST_CASE("a written figure has every cell, the sheet and the metrics, and nothing half-written") {
    const TemporaryFolder folder;
    const FigureConfig config = parse_config(kTiny, "tiny.yaml");
    const Figure figure = render_figure(config);
    write_figure(config, figure, folder / "deep/out");
    std::set<std::string> expected{"sheet.png", "metrics.json", "index.html"};
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
    const render::Metadata png = render::read_image(folder / "deep/out/row2-col3.png").metadata;
    for (const render::Metadata& about : {cell.metadata, png}) {
        CHECK(about.at("Software").rfind("automorph 0.", 0) == 0);
        CHECK(about.at("config_hash") == config_hash(config));
        CHECK(about.at("seed") == "1");
        CHECK(about.at("spp") == "2");
    }
    CHECK(cell.metadata.at("color_space") == "linear, primaries of Rec. 709");
    CHECK(png.at("color_space") == "sRGB");
    const render::Image sheet = render::read_image(folder / "deep/out/sheet.png").image;
    CHECK(sheet.width > 3 * 40);
    const std::string metrics = content(folder / "deep/out/metrics.json");
    for (const char* phrase : {"\"label\": \"turning\"", "\"interpolation\": \"slerp\"", "\"rotation\"",
                               "\"seconds\"", "\"config_text\"", "\"bad_samples\": 0"}) {
        INFO(phrase);
        CHECK(metrics.find(phrase) != std::string::npos);
    }
}

TEST_CASE("metrics tell distortion, and area and volume along the morph of each row") {
    FigureConfig config = parse_config(kTiny, "tiny.yaml", {"title=said", "seed=4"});
    const Figure figure = render_figure(config);
    const auto metrics = nlohmann::json::parse(metrics_json(config, figure));
    CHECK(metrics["config_hash"] == config_hash(config));
    CHECK(metrics["overrides"] == std::vector<std::string>{"title=said", "seed=4"});
    CHECK(metrics["config_text"] == kTiny);
    for (const auto& row : metrics["rows"]) {
        REQUIRE(row["frames"].size() == 7);
        CHECK(row["frames"][0]["alpha"] == 0.0);
        CHECK(row["frames"][0]["volume_ratio"].get<double>() == Approx(1.0).epsilon(1e-12));
        CHECK(row["frames"][6]["alpha"] == 1.0);
        CHECK(row["frames"][6]["area_ratio"].get<double>() == Approx(1.0).epsilon(1e-12));
        for (const auto& frame : row["frames"]) {
            CHECK(frame["area"] > 0.1);
            CHECK(frame["smallest_angle_degrees"] >= 0.0);
            CHECK(frame["reversed_triangles"] >= 0);
            CHECK(frame["self_intersecting_triangles"] >= 0);
        }
    }
    // Two rows share a morph and differ in how it moves, so the ends agree and the middle does not.
    const auto &linear = metrics["rows"][1]["frames"], &slerp = metrics["rows"][2]["frames"];
    CHECK(linear[6] == slerp[6]);
    CHECK(linear[3]["area"] != slerp[3]["area"]);
    for (const auto& morph : metrics["morphs"]) {
        for (const auto& map : morph["maps"]) {
            for (const char* kind : {"area_distortion", "angle_distortion"}) {
                const auto& distortion = map[kind];
                CHECK(distortion["median"] >= 1.0);
                CHECK(distortion["p95"] >= distortion["median"]);
                CHECK(distortion["worst"] >= distortion["p95"]);
            }
        }
        CHECK(morph["stages"].size() > 2);
    }
    FigureOptions unchecked;
    unchecked.check_frames = false;
    CHECK(render_figure(config, unchecked).rows[0].frames.empty());
}

TEST_CASE("selected rows and cells are pictured as in the whole figure", "[sweep]") {
    const FigureConfig config = parse_config(kTiny, "tiny.yaml");
    FigureOptions options;
    options.rows = Selection("1,3");
    options.cells = Selection("2-3");
    const Figure whole = render_figure(config), part = render_figure(config, options);
    REQUIRE(part.rows.size() == 2);
    CHECK(part.rows[1].config.label == "turning");
    CHECK(part.rows[1].number == 2);
    for (const FigureRow& row : part.rows) {
        REQUIRE(row.cells.size() == 2);
        for (const FigureCell& cell : row.cells)
            CHECK(cell.image.pixels == whole.rows[row.number].cells[cell.column].image.pixels);
    }
    const TemporaryFolder folder;
    write_figure(config, part, folder.path());
    CHECK(names_in(folder.path()) == std::set<std::string>{"index.html", "metrics.json", "sheet.png",
                                                           "row1-col2.exr", "row1-col2.png", "row1-col3.exr",
                                                           "row1-col3.png", "row3-col2.exr", "row3-col2.png",
                                                           "row3-col3.exr", "row3-col3.png"});
    options.cells = Selection("4");
    CHECK_THROWS_AS(render_figure(config, options), ConfigError);
    options.cells = {};
    options.rows = Selection("4");
    CHECK_THROWS_AS(render_figure(config, options), ConfigError);
}

TEST_CASE("a page holds its pictures and data, and nothing in a config can end its script") {
    FigureConfig config = parse_config(kTiny, "tiny.yaml", {"title='</script><b>&'"});
    config.rows.resize(1);
    config.rows[0].label = "<img src=x> {{style}}";
    const std::string page = page_html(config, render_figure(config));
    CHECK(page.find("<title>&#60;/script&#62;&#60;b&#62;&#38;</title>") != std::string::npos);
    CHECK(page.find("<img src=x>") == std::string::npos);
    std::size_t scripts = 0;
    for (std::size_t at = 0; (at = page.find("</script>", at)) != std::string::npos; ++at) ++scripts;
    CHECK(scripts == 2);
    CHECK(page.find("http:") == page.find("http://www.w3.org/2000/svg"));  // a name, not asked for
    CHECK(page.find("https:") == std::string::npos);

    const std::string begin = "<script type=\"application/json\" id=\"data\">";
    const std::size_t data = page.find(begin) + begin.size();
    const auto json = nlohmann::json::parse(page.substr(data, page.find("</script>", data) - data));
    CHECK(json["rows"][0]["label"] == "<img src=x> {{style}}");
    CHECK(json["title"] == "</script><b>&");
    REQUIRE(json["rows"][0]["cells"].size() == 3);
    for (const auto& cell : json["rows"][0]["cells"])
        CHECK(cell["image"].get<std::string>().rfind("data:image/jpeg;base64,/9j/", 0) == 0);
    // Without clips, the slider goes through the cells.
    CHECK(json["rows"][0]["motion"]["alphas"] == std::vector<double>{0, 0.5, 1});
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
    write_file(folder / "a.txt", "first");
    write_file(folder / "a.txt", "second");
    CHECK(content(folder / "a.txt") == "second");
    CHECK(names_in(folder.path()) == std::set<std::string>{"a.txt"});

    CHECK_THROWS_AS(write_file(folder / "no/such/folder/a.txt", "x"), IoError);
    fs::create_directories(folder / "taken/inside");
    CHECK_THROWS_AS(write_file(folder / "taken", "x"), IoError);
    CHECK(names_in(folder.path()) == std::set<std::string>{"a.txt", "taken"});
}

TEST_CASE("an output folder that cannot be is an IoError that names it") {
    const TemporaryFolder folder;
    write_file(folder / "file", "x");
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
