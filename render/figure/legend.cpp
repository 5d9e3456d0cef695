#include "render/figure/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "render/film/color_map.h"
#include "render/image/canvas.h"
#include "render/image/text.h"

namespace automorph {

render::Image make_legend(const ColorScale& scale, int width, int size) {
    render::TextStyle style;
    style.size = size;
    style.horizontal = render::HorizontalAlign::Center;
    style.vertical = render::VerticalAlign::Baseline;
    const int bar = std::max(3, size), tick = std::max(2, size / 4), line = size + size / 3;
    const int text_width = render::text_size(scale.meaning, style).width;
    const int whole = std::max(width + 6 * size, text_width + 2);  // numbers stand out beyond the bar
    const int left = (whole - width) / 2;

    render::Image image(whole, bar + tick + 2 * line + size / 2, 3, 1.0f);
    for (int x = 0; x < width; ++x) {
        const render::Color color = render::viridis((x + 0.5) / width);
        for (int y = 0; y < bar; ++y) std::copy_n(color.data(), 3, image.at(left + x, y));
    }
    render::Canvas canvas(image);
    const double pen = std::max(1.0, size / 18.0);
    for (const double share : {0.0, 0.5, 1.0}) {
        const double x = left + pen / 2 + share * (width - pen);
        canvas.line({x, bar}, {x, bar + tick}, {{0.0f, 0.0f, 0.0f}, pen, 1.0});
    }
    image = canvas.image();
    for (const double share : {0.0, 0.5, 1.0}) {
        const double value = (1 - share) * scale.low + share * scale.high;
        render::draw_text(image, left + static_cast<int>(std::lround(share * width)), bar + tick + line,
                          fmt::format("{:.3g}", value), style);
    }
    render::draw_text(image, whole / 2, bar + tick + 2 * line, scale.meaning, style);
    return image;
}

}  // namespace automorph
