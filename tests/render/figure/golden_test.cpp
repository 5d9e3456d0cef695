#include <algorithm>
#include <cmath>

#include "render/figure/text_file.h"
#include "render/image/compare.h"
#include "render/image/image_file.h"
#include "tests/catch.h"
#include "tests/render/figure/golden.h"

using automorph::render::Image;

namespace {

// Reasons: golden/README.md.
constexpr double kLargestRmse = 0.001;  // of linear radiance; the background has 1
constexpr double kOutlier = 0.1;        // a pixel that differs by more in a channel counts as one
constexpr int kMostOutliers = 2;        // of 6400 pixels

Image difference_map(const Image& a, const Image& b) {
    Image map(a.width, a.height);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) map.pixels[i] = std::abs(a.pixels[i] - b.pixels[i]);
    return map;
}

int outliers(const Image& map) {
    int count = 0;
    for (std::size_t i = 0; i < map.pixels.size(); i += 3) {
        const float worst = std::max({map.pixels[i], map.pixels[i + 1], map.pixels[i + 2]});
        count += !(worst <= kOutlier);
    }
    return count;
}

}  // namespace

namespace {

void check_cell(const std::string& name, std::size_t row, std::size_t column, const Image& found) {
    const std::filesystem::path file = golden::file(name, row, column);
    INFO(file);
    const Image expected = automorph::render::read_image(file).image;
    REQUIRE(found.width == expected.width);
    REQUIRE(found.height == expected.height);
    const automorph::render::Difference difference = automorph::render::compare(expected, found);
    const Image map = difference_map(expected, found);
    const bool same = difference.rmse <= kLargestRmse && outliers(map) <= kMostOutliers;
    if (!same) {  // kept for looking at
        const std::filesystem::path kept = std::filesystem::path(AUTOMORPH_GOLDEN_FAILURES) / name;
        automorph::make_folder(kept);
        automorph::render::write_exr(kept / file.filename(), found);
        automorph::render::write_exr(kept / (automorph::cell_name(row, column) + "-difference.exr"), map);
        WARN("kept in " << kept);
    }
    CHECK(difference.rmse <= kLargestRmse);
    CHECK(outliers(map) <= kMostOutliers);
}

void check_figure(const std::string& name) {
    const automorph::Figure figure = automorph::render_figure(golden::config(name), golden::options());
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        for (std::size_t j = 0; j < figure.rows[i].cells.size(); ++j)
            check_cell(name, i, j, figure.rows[i].cells[j].image);
    }
}

}  // namespace

TEST_CASE("figure 7 is pictured as its golden images") {
    check_figure("fig7");
}

TEST_CASE("the other figures are pictured as their golden images", "[sweep]") {
    for (const std::string& name : golden::names()) {
        if (name != "fig7") check_figure(name);
    }
}
