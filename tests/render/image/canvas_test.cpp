#include "render/image/canvas.h"

#include <algorithm>
#include <cmath>

#include "render/image/image_file.h"
#include "tests/catch.h"

using namespace automorph::render;
using Eigen::Vector2d;

namespace {

const Color kBlack{0.0f, 0.0f, 0.0f}, kRed{1.0f, 0.0f, 0.0f};
const Canvas::Pen kNone{kBlack, 0.0};

Canvas paper(int width, int height) {
    return Canvas(Image(width, height, 3, 1.0f));
}

/// How much of the paper a black drawing covers, in pixels. Coverage is blended in 8-bit sRGB codes.
double covered(const Canvas& canvas) {
    double sum = 0.0;
    for (const float value : canvas.image().pixels) sum += 1.0 - to_srgb8(value) / 255.0;
    return sum / 3.0;
}

bool is(const float* pixel, const Color& color) {
    return std::max({std::abs(pixel[0] - color[0]), std::abs(pixel[1] - color[1]),
                     std::abs(pixel[2] - color[2])}) < 1e-6f;
}

}  // namespace

TEST_CASE("a canvas keeps the picture it is made of to 8 bits") {
    Image picture(7, 5);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        picture.pixels[i] = from_srgb8(static_cast<std::uint8_t>(2 * i));
    CHECK(Canvas(picture).image().pixels == picture.pixels);
}

TEST_CASE("what is drawn covers its area, anti-aliased, where it was put") {
    SECTION("a dot") {
        Canvas canvas = paper(40, 40);
        canvas.dot({20.3, 19.6}, 9.0, kBlack, kNone);
        CHECK(covered(canvas) == Approx(3.14159 * 81).epsilon(0.01));
        CHECK(is(canvas.image().at(20, 19), kBlack));
        CHECK(is(canvas.image().at(20, 5), {1, 1, 1}));
    }
    SECTION("a line with round ends") {
        Canvas canvas = paper(60, 30);
        canvas.line({10, 10}, {50, 20}, {kBlack, 2.0});
        CHECK(covered(canvas) == Approx(2.0 * std::hypot(40, 10) + 3.14159).epsilon(0.02));
    }
    SECTION("a polygon, filled and outlined") {
        Canvas canvas = paper(30, 30);
        canvas.polygon({{5, 5}, {25, 5}, {5, 25}}, kRed, {kBlack, 3.0});
        const Image image = canvas.image();
        CHECK(is(image.at(10, 10), kRed));
        CHECK(is(image.at(5, 15), kBlack));
        CHECK(is(image.at(24, 24), {1, 1, 1}));
    }
    SECTION("a faint pen is blended") {
        Canvas canvas = paper(9, 9);
        canvas.line({0, 4.5}, {9, 4.5}, {kBlack, 3.0, 0.5});
        CHECK(to_srgb8(canvas.image().at(4, 4)[1]) / 255.0 == Approx(0.5).margin(0.01));
    }
    SECTION("what lies outside is cut off") {
        Canvas canvas = paper(10, 10);
        canvas.dot({-50, 5}, 20.0, kBlack, kNone);
        canvas.polyline({{20, 20}, {1e5, 1e5}}, {kBlack, 1.0});
        CHECK(covered(canvas) == 0.0);
    }
}
