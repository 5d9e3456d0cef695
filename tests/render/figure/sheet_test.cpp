#include "render/figure/sheet.h"

#include "tests/catch.h"

using namespace automorph;
using render::Image;

namespace {

bool is_color(const Image& image, int x, int y, float r, float g, float b) {
    const float* p = image.at(x, y);
    return p[0] == r && p[1] == g && p[2] == b;
}

// Dark pixels of a part of the sheet: text.
int ink(const Image& image, int x0, int y0, int x1, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) count += image.at(x, y)[0] < 0.5f;
    }
    return count;
}

std::vector<std::vector<Image>> coloured_cells() {
    std::vector<std::vector<Image>> cells(2, std::vector<Image>(3, Image(120, 80)));
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 3; ++column) {
            Image& cell = cells[row][column];
            for (std::size_t i = 0; i < cell.pixels.size(); i += 3) {
                cell.pixels[i] = 0.75f;
                cell.pixels[i + 1] = 0.125f * static_cast<float>(row + 1);
                cell.pixels[i + 2] = 0.125f * static_cast<float>(column + 1);
            }
        }
    }
    return cells;
}

}  // namespace

TEST_CASE("a sheet holds its cells edge to edge, in order, unchanged, on white paper") {
    const Image sheet = make_sheet(coloured_cells(), {"A title", {"first", "second"}, {"a", "b", "c"}});
    REQUIRE(sheet.width > 3 * 120);
    REQUIRE(sheet.height > 2 * 80);
    // The last cell ends where the right and the lower margin begin.
    const int margin = 120 / 12;
    const int left = sheet.width - margin - 3 * 120, top = sheet.height - margin - 2 * 80;
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 3; ++column) {
            const float g = 0.125f * static_cast<float>(row + 1), b = 0.125f * static_cast<float>(column + 1);
            const int x = left + column * 120, y = top + row * 80;
            CHECK(is_color(sheet, x, y, 0.75f, g, b));
            CHECK(is_color(sheet, x + 119, y + 79, 0.75f, g, b));
        }
    }
    for (int x = 0; x < sheet.width; ++x) {
        REQUIRE(is_color(sheet, x, 0, 1, 1, 1));
        REQUIRE(is_color(sheet, x, sheet.height - 1, 1, 1, 1));
    }
    for (int y = 0; y < sheet.height; ++y) {
        REQUIRE(is_color(sheet, 0, y, 1, 1, 1));
        REQUIRE(is_color(sheet, sheet.width - 1, y, 1, 1, 1));
    }
}

TEST_CASE("a sheet has its title on top, row labels on the left and column labels above the columns") {
    const auto cells = coloured_cells();
    const Image sheet = make_sheet(cells, {"A title", {"first", "second"}, {"a", "b", "c"}});
    const int margin = 120 / 12;
    const int left = sheet.width - margin - 3 * 120, top = sheet.height - margin - 2 * 80;
    const int label_top = top - 12;  // label size 9, line height 1.35
    CHECK(ink(sheet, 0, 0, sheet.width, label_top) > 20);
    CHECK(ink(sheet, 0, top, left, top + 80) > 20);
    CHECK(ink(sheet, 0, top + 80, left, top + 160) > 20);
    for (int column = 0; column < 3; ++column) {
        const int x = left + column * 120;
        CHECK(ink(sheet, x + 40, label_top, x + 80, top) > 5);
        CHECK(ink(sheet, x, label_top, x + 40, top) == 0);
    }
    const Image bare = make_sheet(cells, {"", {"", ""}, {"a", "b", "c"}});
    CHECK(bare.width == 3 * 120 + 2 * margin);
    CHECK(bare.height < sheet.height);
}

TEST_CASE("cells fade to their background towards the edge and nowhere else") {
    const Image sheet =
        make_sheet(coloured_cells(), {"", {"", ""}, {"", "", ""}}, {0.25, {0.5f, 0.5f, 0.5f}});
    const int left = 10, top = sheet.height - 10 - 2 * 80;
    // A quarter of half the cell: 15 columns, 10 rows.
    for (int y = 10; y < 70; ++y) {
        for (int x = 15; x < 105; ++x) REQUIRE(is_color(sheet, left + x, top + y, 0.75f, 0.125f, 0.125f));
    }
    for (const int x : {0, 119}) CHECK(sheet.at(left + x, top + 40)[0] == Approx(0.5).margin(0.01));
    for (const int y : {0, 79}) CHECK(sheet.at(left + 60, top + y)[0] == Approx(0.5).margin(0.01));
    float previous = 0.5f;
    for (int x = 0; x < 15; ++x) {
        const float value = sheet.at(left + x, top + 40)[0];
        CHECK(value > previous);
        CHECK(sheet.at(left + 119 - x, top + 40)[0] == Approx(value));
        previous = value;
    }
}

TEST_CASE("numbers print as fractions where they are fractions") {
    CHECK(fraction_text(0) == "0");
    CHECK(fraction_text(1) == "1");
    CHECK(fraction_text(0.25) == "1/4");
    CHECK(fraction_text(1.0 / 3) == "1/3");
    CHECK(fraction_text(0.75) == "3/4");
    CHECK(fraction_text(0.5) == "1/2");
    CHECK(fraction_text(0.137) == "0.137");
    CHECK(fraction_text(0.33) == "0.33");
}

TEST_CASE("labels are broken at spaces") {
    const auto length = [](const std::string& line) { return static_cast<int>(line.size()); };
    using Lines = std::vector<std::string>;
    CHECK(wrap("registration + slerp", 14, length) == Lines{"registration +", "slerp"});
    CHECK(wrap("registration + slerp", 100, length) == Lines{"registration + slerp"});
    CHECK(wrap("unbreakable a b", 3, length) == Lines{"unbreakable", "a b"});
    CHECK(wrap("  spaces   collapse ", 100, length) == Lines{"spaces collapse"});
    CHECK(wrap("", 10, length).empty());
}

TEST_CASE("cells that do not merge stand apart on the paper, and a legend stands below them") {
    const SheetText text{"", {"", ""}, {"a", "b", "c"}};
    const Image dense = make_sheet(coloured_cells(), text);
    SheetFade apart;
    apart.gap = 0.1;
    const Image spread = make_sheet(coloured_cells(), text, apart);
    CHECK(spread.width == dense.width + 2 * 12);
    CHECK(spread.height == dense.height + 12);
    const int margin = 120 / 12;
    CHECK(is_color(spread, spread.width - margin - 120 - 6, spread.height - margin - 40, 1, 1, 1));

    const ColorScale scale{0, 0.25, "metres"};
    const Image with_legend = make_sheet(coloured_cells(), text, {}, scale);
    CHECK(with_legend.width >= dense.width);
    REQUIRE(with_legend.height > dense.height + 20);
    // A bar from dark blue to yellow across the middle, with numbers below it.
    int blue = 0, yellow = 0;
    for (int x = 0; x < with_legend.width; ++x) {
        const float* p = with_legend.at(x, dense.height + 3);
        blue += p[2] > 2 * p[1] && p[0] < 0.1f;
        yellow += p[0] > 0.8f && p[1] > 0.7f && p[2] < 0.1f;
    }
    CHECK(blue > 3);
    CHECK(yellow > 3);
    CHECK(ink(with_legend, 0, dense.height + 12, with_legend.width, with_legend.height) > 20);
}
