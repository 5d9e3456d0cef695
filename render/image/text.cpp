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
        fmt::format("{}: the font is missing; install the package fonts-dejavu-core or set AUTOMORPH_FONT "
                    "to a TrueType file",
                    kFonts[0]));
}

OIIO::ImageBufAlgo::TextAlignX align(HorizontalAlign how) {
    using To = OIIO::ImageBufAlgo::TextAlignX;
    return how == HorizontalAlign::Left ? To::Left : how == HorizontalAlign::Right ? To::Right : To::Center;
}

OIIO::ImageBufAlgo::TextAlignY align(VerticalAlign how) {
    using To = OIIO::ImageBufAlgo::TextAlignY;
    switch (how) {
        case VerticalAlign::Baseline:
            return To::Baseline;
        case VerticalAlign::Top:
            return To::Top;
        case VerticalAlign::Bottom:
            return To::Bottom;
        case VerticalAlign::Center:
            break;
    }
    return To::Center;
}

}  // namespace

TextSize text_size(const std::string& text, const TextStyle& style) {
    if (text.empty()) return {};
    const OIIO::ROI roi = OIIO::ImageBufAlgo::text_size(text, style.size, find_font(style));
    if (!roi.defined()) throw IoError("text cannot be measured: OpenImageIO was built without FreeType");
    return {roi.width(), roi.height()};
}

void draw_text(Image& image, int x, int y, const std::string& text, const TextStyle& style) {
    if (text.empty()) return;
    OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT),
                          image.pixels.data());
    const std::array<float, 3> color{style.color[0], style.color[1], style.color[2]};
    if (!OIIO::ImageBufAlgo::render_text(buffer, x, y, text, style.size, find_font(style), color,
                                         align(style.horizontal), align(style.vertical))) {
        throw IoError(fmt::format("text cannot be drawn: {}", buffer.geterror()));
    }
}

}  // namespace automorph::render
