#include "render/figure/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "render/figure/legend.h"
#include "render/image/text.h"

namespace automorph {
namespace {

using render::HorizontalAlign;
using render::Image;
using render::TextStyle;
using render::VerticalAlign;

// Sizes in proportion to a cell's width, or to a third of the row where it has
// fewer. At 480 pixels a cell printed 4 cm wide, labels have 8 points.
constexpr double kLabelSize = 1.0 / 13;
constexpr double kTitleSize = 1.0 / 10;
constexpr double kMargin = 1.0 / 12;   // around the sheet and between text and cells
constexpr double kLabelColumn = 0.55;  // widest row label before it is broken
constexpr double kLineHeight = 1.35;   // of the font's size
constexpr int kSmallestText = 7;       // pixels: below, nothing can be read

struct Layout {
    int cell_width, cell_height, margin, label_size, title_size;
    int left, top;  ///< of the first cell
    int gap;        ///< between cells
    int legend;     ///< top of the legend
    int width, height;

    int x(std::size_t column) const { return left + static_cast<int>(column) * (cell_width + gap); }
    int y(std::size_t row) const { return top + static_cast<int>(row) * (cell_height + gap); }
};

int scaled(double factor, int size) {
    return static_cast<int>(std::lround(factor * size));
}

/// 0 at the edge of a cell, 1 from `border` pixels on, smooth between.
float fade_weight(int pixel, int size, double border) {
    const double from_edge = std::min(pixel, size - 1 - pixel) + 0.5;
    const double t = border > 0 ? std::clamp(from_edge / border, 0.0, 1.0) : 1.0;
    return static_cast<float>(t * t * (3 - 2 * t));
}

void paste(const Image& cell, Image& sheet, int x, int y, const SheetFade& fade) {
    assert(cell.channels == 3);
    for (int row = 0; row < cell.height; ++row) {
        const float row_weight = fade_weight(row, cell.height, fade.margin * cell.height / 2);
        for (int column = 0; column < cell.width; ++column) {
            const float weight = row_weight * fade_weight(column, cell.width, fade.margin * cell.width / 2);
            for (int channel = 0; channel < 3; ++channel) {
                const float color = cell.at(column, row)[channel];
                sheet.at(x + column, y + row)[channel] =
                    weight == 1.0f ? color : weight * color + (1.0f - weight) * fade.background[channel];
            }
        }
    }
}

int text_width(const std::string& text, int size) {
    TextStyle style;
    style.size = size;
    return render::text_size(text, style).width;
}

/// What sizes are in proportion to, pixels.
int text_unit(const std::vector<std::vector<Image>>& cells) {
    constexpr int kUsualColumns = 3;
    const int columns = std::max(2, static_cast<int>(cells.front().size()));
    return cells.front().front().width * std::min(columns, kUsualColumns) / kUsualColumns;
}

Layout lay_out(const std::vector<std::vector<Image>>& cells, const SheetText& text,
               const std::vector<std::vector<std::string>>& row_lines, double gap, const Image& legend) {
    Layout layout{};
    layout.cell_width = cells.front().front().width;
    layout.cell_height = cells.front().front().height;
    const int unit = text_unit(cells);
    layout.margin = std::max(2, scaled(kMargin, unit));
    layout.label_size = std::max(kSmallestText, scaled(kLabelSize, unit));
    layout.title_size = std::max(kSmallestText, scaled(kTitleSize, unit));
    int label_width = 0;
    for (const auto& lines : row_lines) {
        for (const std::string& line : lines)
            label_width = std::max(label_width, text_width(line, layout.label_size));
    }
    layout.left = layout.margin + (label_width > 0 ? label_width + layout.margin : 0);
    layout.top = layout.margin + scaled(kLineHeight, layout.label_size);
    if (!text.title.empty()) layout.top += scaled(kLineHeight, layout.title_size) + layout.margin;
    layout.gap = scaled(gap, layout.cell_width);
    layout.width = layout.x(cells.front().size() - 1) + layout.cell_width + layout.margin;
    layout.height = layout.y(cells.size() - 1) + layout.cell_height + layout.margin;
    layout.legend = layout.height;
    if (legend.height > 0) layout.height += legend.height + layout.margin;
    layout.width = std::max(layout.width, layout.left + legend.width + layout.margin);
    const int title_width = text.title.empty() ? 0 : text_width(text.title, layout.title_size);
    layout.width = std::max(layout.width, title_width + 2 * layout.margin);
    return layout;
}

void draw_labels(Image& sheet, const Layout& layout, const SheetText& text,
                 const std::vector<std::vector<std::string>>& row_lines) {
    TextStyle style;
    style.horizontal = HorizontalAlign::Center;
    style.vertical = VerticalAlign::Baseline;
    style.size = layout.title_size;
    if (!text.title.empty()) {
        render::draw_text(sheet, layout.width / 2, layout.margin + layout.title_size, text.title, style);
    }
    style.size = layout.label_size;
    const int below = layout.top - scaled(kLineHeight - 1, layout.label_size);
    for (std::size_t column = 0; column < text.columns.size(); ++column) {
        const int x = layout.x(column) + layout.cell_width / 2;
        render::draw_text(sheet, x, below, text.columns[column], style);
    }
    style.horizontal = HorizontalAlign::Left;
    const int line_height = scaled(kLineHeight, layout.label_size);
    for (std::size_t row = 0; row < row_lines.size(); ++row) {
        const int block = static_cast<int>(row_lines[row].size() - 1) * line_height;
        int y = layout.y(row) + layout.cell_height / 2 - block / 2 +
                layout.label_size / 3;  // a third of the size: half the height of small letters, about
        for (const std::string& line : row_lines[row]) {
            render::draw_text(sheet, layout.margin, y, line, style);
            y += line_height;
        }
    }
}

}  // namespace

Image make_sheet(const std::vector<std::vector<Image>>& cells, const SheetText& text, const SheetFade& fade,
                 const std::optional<ColorScale>& scale) {
    assert(!cells.empty() && !cells.front().empty());
    assert(text.rows.size() == cells.size() && text.columns.size() == cells.front().size());
    const int unit = text_unit(cells);
    const int label_size = std::max(kSmallestText, scaled(kLabelSize, unit));
    std::vector<std::vector<std::string>> row_lines;
    for (const std::string& label : text.rows) {
        row_lines.push_back(wrap(label, scaled(kLabelColumn, unit),
                                 [&](const std::string& line) { return text_width(line, label_size); }));
    }
    constexpr double kLegend = 1.4;  // length of the bar, relative to what text is in proportion to
    const Image legend = scale ? make_legend(*scale, scaled(kLegend, unit), label_size) : Image(0, 0);
    const Layout layout = lay_out(cells, text, row_lines, fade.gap, legend);
    Image sheet(layout.width, layout.height, 3, 1.0f);
    for (std::size_t row = 0; row < cells.size(); ++row) {
        for (std::size_t column = 0; column < cells[row].size(); ++column) {
            paste(cells[row][column], sheet, layout.x(column), layout.y(row), fade);
        }
    }
    const int cells_end = layout.x(cells.front().size() - 1) + layout.cell_width;
    paste(legend, sheet, std::max(layout.left, (layout.left + cells_end - legend.width) / 2), layout.legend,
          {});
    draw_labels(sheet, layout, text, row_lines);
    return sheet;
}

std::string fraction_text(double value) {
    constexpr int kLargestDenominator = 16;
    for (int below = 1; below <= kLargestDenominator; ++below) {
        const double above = std::round(value * below);
        if (std::abs(value - above / below) > 1e-12) continue;
        return below == 1 ? fmt::format("{:.0f}", above) : fmt::format("{:.0f}/{}", above, below);
    }
    return fmt::format("{:.3g}", value);
}

}  // namespace automorph
