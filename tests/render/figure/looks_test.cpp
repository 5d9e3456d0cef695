// Materials, lights, lens, edges, colours, markers, denoising and tone curves by way of configs.
#include <algorithm>
#include <array>
#include <cmath>

#include "morph/mesh/errors.h"
#include "render/compare/difference.h"
#include "render/figure/figure.h"
#include "render/image/image_file.h"
#include "tests/catch.h"
#include "tests/files.h"

using namespace automorph;

namespace {

const std::string kSphere = R"(show: looks
source: {shape: ellipsoid, semi_axes: [1, 1, 1], triangles: 2000}
)";

Figure figure_of(const std::string& text, const std::filesystem::path& file = "looks.yaml") {
    FigureOptions options;
    options.embree_config = "isa=sse4.2";
    return render_figure(parse_config(text, file), options);
}

const render::Image& only_cell(const Figure& figure) {
    REQUIRE(figure.rows.size() == 1);
    REQUIRE(figure.rows[0].cells.size() == 1);
    return figure.rows[0].cells[0].image;
}

render::Image sphere(const std::string& picture) {
    return only_cell(
        figure_of(kSphere + "looks: [{label: x}]\npicture: {width: 48, height: 48, " + picture + "}\n"));
}

double apart(const render::Image& a, const render::Image& b) {
    return render::compare(a, b).rmse;
}

}  // namespace

TEST_CASE("looks are columns, stages rows, and a stage alone is the picture itself") {
    const std::string picture = "picture: {width: 32, height: 32, spp: 4}\n";
    const Figure figure = figure_of(kSphere + picture + R"(looks:
  - {label: clay}
  - {label: gold, albedo: [1, 0.7, 0.3], material: {metallic: 1}}
stages:
  - {label: studio}
  - {label: sky, light: gradient}
)");
    REQUIRE(figure.rows.size() == 2);
    CHECK(figure.rows[1].config.label == "sky");
    for (const FigureRow& row : figure.rows) {
        REQUIRE(row.cells.size() == 2);
        CHECK(row.cells[1].label == "gold");
        CHECK(apart(row.cells[0].image, row.cells[1].image) > 0.02);
        for (const FigureCell& cell : row.cells) CHECK(cell.bad_samples == 0);
    }
    CHECK(apart(figure.rows[0].cells[0].image, figure.rows[1].cells[0].image) > 0.02);
    const Figure alone = figure_of(kSphere + picture + "looks: [{label: clay}]\n");
    CHECK(only_cell(alone).pixels == figure.rows[0].cells[0].image.pixels);
}

TEST_CASE("the defaults of material, light, lens and edges are what was there before them") {
    const render::Image plain = sphere("spp: 4");
    const render::Image spelled = sphere(
        "spp: 4, material: {metallic: 0, specular: 0}, light: {kind: studio, strength: 1, rim: 0}, "
        "lens: {radius: 0}, wireframe: 0, ground: true");
    CHECK(plain.pixels == spelled.pixels);
}

TEST_CASE("an adaptive picture takes fewer paths and shows the same") {
    const std::string picture = kSphere + "looks: [{label: x}]\npicture: {width: 48, height: 48, spp: 256";
    const Figure whole = figure_of(picture + "}\n"), adaptive = figure_of(picture + ", adaptive: 0.05}\n");
    const FigureCell& cell = adaptive.rows[0].cells[0];
    CHECK(cell.samples < whole.rows[0].cells[0].samples / 2);
    CHECK(apart(cell.image, only_cell(whole)) < 0.02);
    CHECK(apart(cell.image, only_cell(whole)) > 0);
}

TEST_CASE("a surface gives off its emission") {
    const render::Image image = sphere(
        "spp: 4, background: [0, 0, 0], ground: none, light: {strength: 0}, "
        "material: {emission: [2, 1, 0.25]}");
    for (int c = 0; c < 3; ++c) {
        CHECK(image.at(24, 24)[c] == Approx(std::array{2.0, 1.0, 0.25}[static_cast<std::size_t>(c)]));
        CHECK(image.at(0, 0)[c] == 0.0f);
    }
}

TEST_CASE("the box filter keeps an edge to the pixels that it crosses") {
    const auto shades = [&](const std::string& filter) {
        const render::Image image = sphere(
            "spp: 64, background: [0, 0, 0], ground: none, light: {strength: 0}, "
            "material: {emission: [1, 1, 1]}, filter: " +
            filter);
        return static_cast<double>(std::count_if(image.pixels.begin(), image.pixels.end(),
                                                 [](float value) { return value > 0.0f && value < 1.0f; }));
    };
    const double box = shades("box");
    CHECK(box > 100);
    CHECK(shades("blackman-harris") > 1.3 * box);
}

TEST_CASE("a sky from a file lights as its mirror image in the sky does, turned by its rotation") {
    // All light comes from one patch in the middle of the map's left half: from the left of the camera.
    const TemporaryFolder folder;
    render::Image map(16, 8, 3, 0.0f);
    for (int c = 0; c < 3; ++c)
        for (int row = 3; row < 5; ++row) map.at(3, row)[c] = map.at(4, row)[c] = 20.0f;
    render::write_exr(folder / "sky.exr", map);
    const auto lit = [&](const std::string& rotation) {
        return only_cell(
            figure_of(kSphere +
                          "looks: [{label: x}]\npicture: {width: 32, height: 32, spp: 16, view: [0, 1, "
                          "0], ground: none, background: [0, 0, 0], light: {kind: sky, map: sky.exr, "
                          "rotation: " +
                          rotation + "}}\n",
                      folder / "looks.yaml"));
    };
    const auto half = [](const render::Image& image, bool right) {
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < 16; ++x) sum += static_cast<double>(image.at(right ? x + 16 : x, y)[1]);
        return sum;
    };
    const render::Image left = lit("0"), right = lit("180"), behind = lit("-90"), front = lit("90");
    CHECK(half(left, false) > 20 * half(left, true));
    CHECK(half(right, true) > 20 * half(right, false));
    CHECK(half(front, false) == Approx(half(front, true)).epsilon(0.1));
    CHECK(half(front, false) > half(left, false));
    CHECK(half(behind, false) < 0.1 * half(front, false));
    CHECK_THROWS_AS(figure_of(kSphere + "looks: [{label: x}]\npicture: {light: {kind: sky, map: none.exr}}\n",
                              folder / "looks.yaml"),
                    IoError);
}

TEST_CASE("a lens blurs the outline unless it is in focus") {
    // Sharpness of the outline: the largest step between neighbours in the middle row.
    const auto step = [](const render::Image& image) {
        float largest = 0;
        for (int x = 1; x < image.width; ++x)
            largest = std::max(largest, std::abs(image.at(x, 24)[1] - image.at(x - 1, 24)[1]));
        return largest;
    };
    const std::string common = "spp: 64, ground: none, albedo: [0, 0, 0]";
    const float sharp = step(sphere(common)), focused = step(sphere(common + ", lens: {radius: 0.1}")),
                blurred = step(sphere(common + ", lens: {radius: 0.1, focus: 1}"));
    CHECK(focused > 0.6f * sharp);
    CHECK(blurred < 0.6f * focused);
}

TEST_CASE("edges are as wide in a small figure, in proportion, as in a large one") {
    const std::string text = kSphere +
                             "looks: [{label: x}]\npicture: {width: 96, height: 96, spp: 16, ground: none, "
                             "wireframe: {width: 2, color: [0, 0, 0]}}\n";
    const auto mean = [](const render::Image& image) {
        double sum = 0;
        for (const float value : image.pixels) sum += static_cast<double>(value);
        return sum / static_cast<double>(image.pixels.size());
    };
    FigureOptions options;
    const double whole = mean(only_cell(render_figure(parse_config(text, "x.yaml"), options)));
    options.scale = 0.5;
    const double half = mean(only_cell(render_figure(parse_config(text, "x.yaml"), options)));
    const double bare = mean(sphere("spp: 16, ground: none"));
    CHECK(whole < 0.95 * bare);
    CHECK(half == Approx(whole).epsilon(0.01));
}

TEST_CASE("a figure coloured by displacement has one scale, a legend, and blue where nothing moved") {
    const std::string text = R"(source: {shape: ellipsoid, semi_axes: [1, 1, 1], triangles: 500}
target: {shape: ellipsoid, semi_axes: [1, 1, 2], triangles: 500, seed: 2}
rows: [{label: r, alignment: none, interpolation: linear}]
alphas: [0, 1]
picture: {width: 40, height: 40, spp: 8, ground: none, color: displacement, markers: {kind: spread, count: 5}}
)";
    const FigureConfig config = parse_config(text, "x.yaml");
    const Figure figure = render_figure(config);
    REQUIRE(figure.scale);
    CHECK(figure.scale->low == 0);
    CHECK(figure.scale->high > 0.3);
    CHECK(figure.scale->high < 3);
    // Dark blue before it moves; markers cover little.
    int blue = 0, body = 0;
    const render::Image& still = figure.rows[0].cells[0].image;
    for (std::size_t i = 0; i < still.pixels.size(); i += 3) {
        if (still.pixels[i] > 0.95f && still.pixels[i + 1] > 0.95f) continue;
        ++body;
        blue += still.pixels[i + 2] > 2 * still.pixels[i + 1];
    }
    CHECK(blue > 0.7 * body);
    CHECK(apart(still, figure.rows[0].cells[1].image) > 0.05);
    FigureConfig plain = config;
    plain.picture.color = ColorField::None;
    CHECK_FALSE(render_figure(plain).scale);
    const render::Image sheet = figure_sheet(config, figure);
    CHECK(sheet.height > figure_sheet(plain, render_figure(plain)).height + 10);
}

TEST_CASE("denoising is asked for by config or option, and brings a preview nearer to the truth", "[sweep]") {
    const std::string text = kSphere + "looks: [{label: x}]\npicture: {width: 64, height: 64, spp: 8}\n";
    const FigureConfig config = parse_config(text, "x.yaml");
    FigureConfig asked = config;
    asked.picture.denoise = true;
    FigureOptions options, truth;
    options.denoise = true;
    truth.spp = 512;
    const render::Image noisy = only_cell(render_figure(config)), quiet = only_cell(render_figure(asked)),
                        reference = only_cell(render_figure(config, truth));
    CHECK(only_cell(render_figure(config, options)).pixels == quiet.pixels);
    CHECK(apart(quiet, reference) < 0.7 * apart(noisy, reference));
}

TEST_CASE("PNG files follow the tone curve and the bits of the config, EXR files stay linear") {
    const TemporaryFolder folder;
    FigureConfig config = parse_config(
        kSphere + "looks: [{label: x}]\npicture: {width: 24, height: 24, spp: 4, curve: filmic, bits: 16}\n",
        "x.yaml");
    const Figure figure = render_figure(config);
    write_figure(config, figure, folder.path());
    const render::Image& linear = only_cell(figure);
    CHECK(render::read_image(folder / "row1-col1.exr").image.pixels == linear.pixels);
    const render::Image png = render::read_image(folder / "row1-col1.png").image;
    double largest = 0;
    for (std::size_t i = 0; i < png.pixels.size(); ++i) {
        const float expected = std::clamp(render::filmic(linear.pixels[i]), 0.0f, 1.0f);
        largest = std::max(largest, std::abs(static_cast<double>(png.pixels[i] - expected)));
    }
    CHECK(largest < 1e-4);  // of 16 bits; of 8 bits steps are up to 0.009
    // The sheet shows what the cell's file shows.
    const render::Image sheet = render::read_image(folder / "sheet.png").image;
    float nearest = 1;
    for (int y = 0; y < sheet.height; ++y)
        for (int x = 0; x < sheet.width; ++x)
            nearest = std::min(nearest, std::abs(sheet.at(x, y)[1] - png.at(12, 12)[1]));
    CHECK(nearest < 1e-4f);
}
