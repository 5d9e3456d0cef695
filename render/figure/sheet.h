#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "render/figure/color_field.h"
#include "render/film/image.h"
#include "render/math/vec.h"

namespace automorph {

/// What is printed around the cells.
struct SheetText {
    std::string title;              ///< above everything; may be empty
    std::vector<std::string> rows;  ///< left of each row, broken at spaces where too long; all may be empty
    std::vector<std::string> columns;  ///< above each column
};

/// How cells that show a shadow merge: towards its edge each cell fades to the background they share.
struct SheetFade {
    double margin =
        0;  ///< the faded border on each side, as a fraction of half the cell; no shape reaches there
    render::Color background{1.0f, 1.0f, 1.0f};  ///< linear
    double gap = 0;  ///< white between cells that do not merge, as a fraction of their width
};

/// Lays the cells out on white paper, edge to edge or with a gap, with a title and labels in proportion to
/// the cells, and below them, if they are coloured by numbers, the legend.
/// @param cells  rows of equally many pictures of one size, three channels
/// @throws IoError if the font is missing
/// @pre   at least one cell; one label per row and column
render::Image make_sheet(const std::vector<std::vector<render::Image>>& cells, const SheetText& text,
                         const SheetFade& fade = {}, const std::optional<ColorScale>& scale = {});

/// "0", "1/4", "2/3": the number as a fraction where a small one equals it to 1e-12, else a decimal.
std::string fraction_text(double value);

/// Breaks text at spaces into lines of at most `width` by `measure`; a longer word has a line to itself.
template <class Measure>
std::vector<std::string> wrap(const std::string& text, int width, Measure measure) {
    std::vector<std::string> lines;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (!word.empty()) {
            const std::string longer = lines.empty() ? word : lines.back() + " " + word;
            if (lines.empty() || measure(longer) > width) {
                lines.push_back(word);
            } else {
                lines.back() = longer;
            }
        }
        begin = end + 1;
    }
    return lines;
}

}  // namespace automorph
