#include <algorithm>
#include <cmath>

#include "render/figure/text_file.h"
#include "render/image/compare.h"
#include "render/image/image_file.h"
#include "tests/catch.h"
#include "tests/render/figure/golden.h"

using automorph::render::Image;

namespace {

// Reasons: golden/fig7/README.md.
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

TEST_CASE("figure 7 is pictured as its golden images") {
    const automorph::Figure figure = automorph::render_figure(golden::config(), golden::options());
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        for (std::size_t j = 0; j < figure.rows[i].cells.size(); ++j) {
            INFO(golden::file(i, j));
            const Image expected = automorph::render::read_image(golden::file(i, j)).image;
            const Image& found = figure.rows[i].cells[j].image;
            REQUIRE(found.width == expected.width);
            REQUIRE(found.height == expected.height);
            const automorph::render::Difference difference = automorph::render::compare(expected, found);
            const Image map = difference_map(expected, found);
            const bool same = difference.rmse <= kLargestRmse && outliers(map) <= kMostOutliers;
            if (!same) {  // kept for looking at
                const std::filesystem::path kept = AUTOMORPH_GOLDEN_FAILURES;
                automorph::make_folder(kept);
                automorph::render::write_exr(kept / (automorph::cell_name(i, j) + ".exr"), found);
                automorph::render::write_exr(kept / (automorph::cell_name(i, j) + "-difference.exr"), map);
                WARN("kept in " << kept);
            }
            CHECK(difference.rmse <= kLargestRmse);
            CHECK(outliers(map) <= kMostOutliers);
        }
    }
}
