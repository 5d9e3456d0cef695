#include "tests/render/figure/golden.h"
#include "morph/mesh/write_file.h"
#include "render/compare/pictures.h"
#include "render/compare/same_seed.h"
#include "render/image/image_file.h"
#include "tests/catch.h"

using automorph::render::Image;

namespace {

void check_cell(const std::string& name, std::size_t row, std::size_t column, const Image& found) {
    const std::filesystem::path file = golden::file(name, row, column);
    INFO(file);
    const Image expected = automorph::render::read_image(file).image;
    // The reasons for the limits: golden/README.md.
    const automorph::render::Comparison comparison = automorph::render::compare_same_seed(expected, found);
    if (!comparison.same()) {  // kept for looking at
        const std::filesystem::path kept = std::filesystem::path(AUTOMORPH_GOLDEN_FAILURES) / name;
        automorph::make_folder(kept);
        automorph::render::write_exr(kept / file.filename(), found);
        automorph::render::write_png(kept / (automorph::cell_name(row, column) + "-difference.png"),
                                     automorph::render::side_by_side(expected, found, comparison));
        WARN("kept in " << kept);
    }
    for (const automorph::render::TestResult& test : comparison.tests) {
        INFO(test.name << ", worst at (" << test.where.x << ", " << test.where.y << ")");
        CHECK(test.value <= test.limit);
    }
}

void check_figure(const std::string& name) {
    const automorph::Figure figure = automorph::render_figure(golden::config(name), golden::options());
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        for (std::size_t j = 0; j < figure.rows[i].cells.size(); ++j)
            check_cell(name, i, j, figure.rows[i].cells[j].image);
    }
}

}  // namespace

TEST_CASE("figure 7 is pictured as its golden images", "[sweep]") {
    check_figure("fig7");
}

TEST_CASE("the other figures are pictured as their golden images", "[sweep]") {
    for (const std::string& name : golden::names()) {
        if (name != "fig7") check_figure(name);
    }
}
