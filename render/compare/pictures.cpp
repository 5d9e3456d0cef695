#include "render/compare/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "render/compare/difference.h"
#include "render/film/color_map.h"
#include "render/image/text.h"
#include "render/math/vec.h"

namespace automorph::render {
namespace {

// Pixels of the picture made.
constexpr int kReadable = 320;  // pictures narrower than this are enlarged
constexpr int kGap = 12;
constexpr int kTextSize = 13;
constexpr int kCaption = 22;  // height of a line of text
constexpr int kBar = 16;      // width of the legend's bar
constexpr int kLegend = 150;  // with its text

constexpr float kPaper = 1.0f;

int enlargement(const Image& image) {
    return std::max(1, (kReadable + image.width - 1) / image.width);
}

template <class ColorAt>
void paint(Image& to, int x0, int y0, int width, int height, const ColorAt& color_at) {
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Color color = color_at(x, y);
            std::copy_n(color.data(), 3, to.at(x0 + x, y0 + y));
        }
    }
}

// What is not finite shows as magenta, which neither pictures nor viridis hold.
Color shown(const Image& image, int x, int y) {
    const float* pixel = image.at(x, y);
    const Color color = image.channels >= 3 ? Color(pixel[0], pixel[1], pixel[2]) : Color::Constant(pixel[0]);
    return color.allFinite() ? color : Color(1.0f, 0.0f, 1.0f);
}

/// The severity that the end of the colours stands for.
double top_of(const Comparison& comparison) {
    return comparison.severity_unit == "limit" || comparison.severity_unit == "outlier" ? 2.0 : 1.0;
}

void paint_map(Image& to, int x0, int y0, const Comparison& comparison) {
    const int factor = enlargement(comparison.severity);
    const double top = top_of(comparison);
    paint(to, x0, y0, factor * comparison.severity.width, factor * comparison.severity.height,
          [&](int x, int y) { return viridis(*comparison.severity.at(x / factor, y / factor) / top); });
}

void paint_legend(Image& to, int x0, int y0, int height, const Comparison& comparison) {
    paint(to, x0, y0, kBar, height, [&](int, int y) { return viridis(1.0 - (y + 0.5) / height); });
    TextStyle style;
    style.size = kTextSize;
    const int x = x0 + kBar + 6;
    const double top = top_of(comparison);
    const std::string unit = comparison.severity_unit;
    style.vertical = VerticalAlign::Top;
    draw_text(to, x, y0, top > 1.0 ? fmt::format("{:.0f} x {}, or more", top, unit) : unit, style);
    style.vertical = VerticalAlign::Center;
    if (top > 1.0) draw_text(to, x, y0 + height / 2, unit, style);
    style.vertical = VerticalAlign::Bottom;
    draw_text(to, x, y0 + height, "no difference", style);
}

int legend_height(const Image& image) {
    return std::max(enlargement(image) * image.height, 4 * kTextSize);
}

}  // namespace

Image heat_map(const Comparison& comparison) {
    const Image& severity = comparison.severity;
    const int width = enlargement(severity) * severity.width, height = legend_height(severity);
    Image result(width + kGap + kLegend, height, 3, kPaper);
    paint_map(result, 0, 0, comparison);
    paint_legend(result, width + kGap, 0, height, comparison);
    return result;
}

Image side_by_side(const Image& golden, const Image& found, const Comparison& comparison) {
    require_same_shape(golden, found);
    const int factor = enlargement(golden);
    const int width = factor * golden.width, height = legend_height(golden);
    const auto left = [&](int panel) { return kGap + panel * (width + kGap); };
    const int top = kGap + kCaption;
    Image result(left(3) + kLegend, top + height + kGap, 3, kPaper);
    const auto paint_picture = [&](int panel, const Image& image) {
        paint(result, left(panel), top, width, factor * image.height,
              [&](int x, int y) { return shown(image, x / factor, y / factor); });
    };
    paint_picture(0, golden);
    paint_picture(1, found);
    paint_map(result, left(2), top, comparison);
    paint_legend(result, left(3), top, height, comparison);

    TextStyle style;
    style.size = kTextSize;
    const std::array<std::string, 3> captions{"golden", "new", "difference / " + comparison.severity_unit};
    for (int panel = 0; panel < 3; ++panel) {
        draw_text(result, left(panel), top - kCaption / 3, captions[static_cast<std::size_t>(panel)], style);
    }
    return result;
}

}  // namespace automorph::render
