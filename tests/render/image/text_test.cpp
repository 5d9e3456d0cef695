#include "render/image/text.h"

#include <algorithm>

#include "morph/mesh/errors.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::render;

namespace {

struct Ink {
    int left, right, top, bottom;  // inclusive
};

// The box of the pixels that are not white.
Ink ink_of(const Image& image) {
    Ink ink{image.width, -1, image.height, -1};
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (*std::min_element(image.at(x, y), image.at(x, y) + 3) > 0.99f) continue;
            ink = {std::min(ink.left, x), std::max(ink.right, x), std::min(ink.top, y),
                   std::max(ink.bottom, y)};
        }
    }
    return ink;
}

}  // namespace

TEST_CASE("text is drawn where its alignment says") {
    TextStyle style;
    style.size = 20;
    const TextSize size = text_size("Half", style);
    CHECK(size.width > 25);
    CHECK(size.width < 60);
    CHECK(size.height > 10);
    CHECK(size.height < 24);
    for (HorizontalAlign horizontal :
         {HorizontalAlign::Left, HorizontalAlign::Center, HorizontalAlign::Right}) {
        style.horizontal = horizontal;
        Image image(200, 60, 3, 1.0f);
        draw_text(image, 100, 40, "Half", style);
        const Ink ink = ink_of(image);
        const int width = ink.right - ink.left + 1;
        CHECK(std::abs(width - size.width) <= 1);
        if (horizontal == HorizontalAlign::Left) CHECK(std::abs(ink.left - 100) <= 1);
        if (horizontal == HorizontalAlign::Center) CHECK(std::abs(ink.left + ink.right - 199) <= 2);
        if (horizontal == HorizontalAlign::Right) CHECK(std::abs(ink.right - 99) <= 1);
        CHECK(std::abs(ink.bottom - 39) <= 1);  // on the baseline
    }
    for (VerticalAlign vertical : {VerticalAlign::Top, VerticalAlign::Center, VerticalAlign::Bottom}) {
        style.vertical = vertical;
        Image image(200, 60, 3, 1.0f);
        draw_text(image, 190, 30, "Half", style);
        const Ink ink = ink_of(image);
        if (vertical == VerticalAlign::Top) CHECK(std::abs(ink.top - 30) <= 1);
        if (vertical == VerticalAlign::Center) CHECK(std::abs(ink.top + ink.bottom - 59) <= 2);
        if (vertical == VerticalAlign::Bottom) CHECK(std::abs(ink.bottom - 29) <= 1);
    }
}

TEST_CASE("size and colour of text can be chosen, and other letters than Latin ones drawn") {
    TextStyle style;
    style.size = 12;
    const TextSize small = text_size("\u03b1 = \u00bd", style);
    style.size = 48;
    const TextSize large = text_size("\u03b1 = \u00bd", style);
    CHECK(large.width > 3.5 * small.width);
    CHECK(large.width < 4.5 * small.width);
    style.color = {1.0f, 0.0f, 0.0f};
    Image image(300, 80, 3, 1.0f);
    draw_text(image, 10, 60, "\u03b1 = \u00bd", style);
    float least_red = 1.0f, least_green = 1.0f;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        least_red = std::min(least_red, image.pixels[i]);
        least_green = std::min(least_green, image.pixels[i + 1]);
    }
    CHECK(least_red > 0.99f);
    CHECK(least_green < 0.01f);
}

TEST_CASE("text beyond the border is cut off, no text leaves the picture alone") {
    Image image(30, 20, 3, 1.0f);
    draw_text(image, -10, 10, "cut off on both sides of the picture");
    draw_text(image, 500, 500, "far away");
    CHECK(ink_of(image).right >= 0);
    Image white(30, 20, 3, 1.0f);
    draw_text(white, 5, 10, "");
    CHECK(ink_of(white).right == -1);
    CHECK(text_size("").width == 0);
}

TEST_CASE("a missing font is an error that names it") {
    TextStyle style;
    style.font = "/none/such.ttf";
    Image image(30, 20);
    CHECK_THROWS_AS(text_size("a", style), IoError);
    CHECK_THROWS_AS(draw_text(image, 0, 0, "a", style), IoError);
}
