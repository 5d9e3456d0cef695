#include "render/compare/pictures.h"

#include "morph/mesh/errors.h"
#include "render/compare/same_seed.h"
#include "render/film/color_map.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::render;

namespace {

bool is(const Image& image, int x, int y, const Color& color) {
    return (Color(image.at(x, y)[0], image.at(x, y)[1], image.at(x, y)[2]) - color).abs().maxCoeff() < 1e-6f;
}

}  // namespace

TEST_CASE("the heat map shows each pixel's severity, enlarged, and a legend beside it") {
    Comparison comparison{{}, Image(40, 20, 1), "limit"};
    *comparison.severity.at(3, 4) = 1.0f;
    *comparison.severity.at(39, 19) = 7.0f;
    const Image map = heat_map(comparison);
    CHECK(map.width > 320);
    CHECK(map.height == 160);  // 8 times
    CHECK(is(map, 8 * 3, 8 * 4, viridis(0.5)));
    CHECK(is(map, 8 * 3 + 7, 8 * 4 + 7, viridis(0.5)));
    CHECK(is(map, 8 * 4, 8 * 4, viridis(0.0)));
    CHECK(is(map, 319, 159, viridis(1.0)));
    int ink = 0;  // of the legend's text
    for (int y = 0; y < map.height; ++y) {
        for (int x = 320 + 34; x < map.width; ++x) ink += map.at(x, y)[0] < 0.5f;
    }
    CHECK(ink > 50);
}

TEST_CASE("golden, new and heat map stand beside each other") {
    const Image golden(400, 50, 3, 0.25f);
    Image found = golden;
    found.at(10, 20)[0] = 0.75f;
    const Comparison comparison = compare_same_seed(golden, found);
    const Image picture = side_by_side(golden, found, comparison);
    CHECK(picture.width > 3 * 400);
    CHECK(picture.height > 50);
    CHECK(is(picture, 12 + 10, 34 + 20, {0.25f, 0.25f, 0.25f}));
    CHECK(is(picture, 12 + 412 + 10, 34 + 20, {0.75f, 0.25f, 0.25f}));
    CHECK(is(picture, 12 + 2 * 412 + 10, 34 + 20, viridis(1.0)));
    CHECK(is(picture, 12 + 2 * 412 + 11, 34 + 20, viridis(0.0)));
    CHECK_THROWS_AS(side_by_side(golden, Image(40, 50), comparison), Error);
}
