#pragma once

#include <string>

#include "render/film/image.h"
#include "render/math/vec.h"

namespace automorph::render {

enum class HorizontalAlign { Left, Center, Right };
enum class VerticalAlign { Baseline, Top, Center, Bottom };

struct TextStyle {
    int size = 16;  ///< font height in pixels
    HorizontalAlign horizontal = HorizontalAlign::Left;
    VerticalAlign vertical = VerticalAlign::Baseline;
    Color color{0.0f, 0.0f, 0.0f};  ///< linear
    std::string font;               ///< a font file; empty takes $AUTOMORPH_FONT or DejaVu Sans
};

/// Extent of the ink in pixels.
struct TextSize {
    int width = 0;
    int height = 0;
};

/// @throws IoError if the font is missing, with the package to install
TextSize text_size(const std::string& text, const TextStyle& style = {});

/// Draws UTF-8 text with (x, y) as its anchor; what lies outside the picture is cut off.
/// @throws IoError as above
void draw_text(Image& image, int x, int y, const std::string& text, const TextStyle& style = {});

}  // namespace automorph::render
