#include "render/image/text.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <filesystem>

#include "morph/mesh/errors.h"

namespace automorph::render {
namespace {

constexpr std::array kFonts = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                               "/usr/share/fonts/TTF/DejaVuSans.ttf",
                               "/usr/share/fonts/dejavu/DejaVuSans.ttf"};

std::string find_font(const TextStyle& style) {
    const char* chosen = std::getenv("AUTOMORPH_FONT");
    const std::string wanted = !style.font.empty() ? style.font : chosen != nullptr ? chosen : "";
    if (!wanted.empty()) {
        if (std::filesystem::is_regular_file(wanted)) return wanted;
        throw IoError(fmt::format("{}: no such font file", wanted));
    }
    for (const char* font : kFonts) {
        if (std::filesystem::is_regular_file(font)) return font;
    }
    throw IoError(
        fmt::format("{}: the font is missing; install the package fonts-dejavu-core or set "
                    "AUTOMORPH_FONT to a TrueType file",
                    kFonts[0]));
}

// The ink's box about the start of the baseline.
OIIO::ROI ink(const std::string& text, int size, const std::string& font) {
    const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(text, size, font);
    if (!box.defined()) {
        throw IoError(
            fmt::format("{}: text cannot be measured: either the file is not a font or OpenImageIO was "
                        "built without FreeType",
                        font));
    }
    return box;
}

// Where the baseline starts for an anchor; OpenImageIO's own alignment to the bottom depends on its version.
int start(int x, const OIIO::ROI& box, HorizontalAlign how) {
    if (how == HorizontalAlign::Left) return x - box.xbegin;
    if (how == HorizontalAlign::Right) return x - box.xend;
    return x - (box.xbegin + box.xend) / 2;
}

int baseline(int y, const OIIO::ROI& box, VerticalAlign how) {
    if (how == VerticalAlign::Baseline) return y;
    if (how == VerticalAlign::Top) return y - box.ybegin;
    if (how == VerticalAlign::Bottom) return y - box.yend;
    return y - (box.ybegin + box.yend) / 2;
}

}  // namespace

TextSize text_size(const std::string& text, const TextStyle& style) {
    const std::string font = find_font(style);
    if (text.empty()) return {};
    const OIIO::ROI box = ink(text, style.size, font);
    return {box.width(), box.height()};
}

void draw_text(Image& image, int x, int y, const std::string& text, const TextStyle& style) {
    const std::string font = find_font(style);
    if (text.empty()) return;
    const OIIO::ROI box = ink(text, style.size, font);
    OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT),
                          image.pixels.data());
    const std::array<float, 3> color{style.color[0], style.color[1], style.color[2]};
    if (!OIIO::ImageBufAlgo::render_text(buffer, start(x, box, style.horizontal),
                                         baseline(y, box, style.vertical), text, style.size, font, color)) {
        throw IoError(fmt::format("text cannot be drawn: {}", buffer.geterror()));
    }
}

}  // namespace automorph::render
