#include "render/image/text.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "morph/mesh/errors.h"

// FreeType itself: OpenImageIO's text calls of Debian 12 draw no character beyond ASCII.

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
        fmt::format("{}: the font is missing; install the package fonts-dejavu-core or set AUTOMORPH_FONT to "
                    "a TrueType file",
                    kFonts[0]));
}

/// A font at one size.
class Font {
public:
    Font(const std::string& file, int size) {
        if (FT_Init_FreeType(&library_) != 0) throw IoError("FreeType does not start");
        if (FT_New_Face(library_, file.c_str(), 0, &face_) != 0) {
            FT_Done_FreeType(library_);
            throw IoError(fmt::format("{}: not a font that FreeType reads", file));
        }
        FT_Set_Pixel_Sizes(face_, 0, static_cast<FT_UInt>(size));
    }
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;
    ~Font() {
        FT_Done_Face(face_);
        FT_Done_FreeType(library_);
    }

    /// Calls draw(left, top, bitmap) for every glyph, in pixels from the start of the baseline, y down.
    template <typename Draw>
    void set(const std::u32string& text, const Draw& draw) {
        FT_Pos pen = 0;  // 1/64 pixel
        FT_UInt before = 0;
        for (const char32_t character : text) {
            const FT_UInt glyph = FT_Get_Char_Index(face_, character);
            FT_Vector kerning{};
            if (before != 0 && glyph != 0) FT_Get_Kerning(face_, before, glyph, FT_KERNING_DEFAULT, &kerning);
            pen += kerning.x;
            if (FT_Load_Glyph(face_, glyph, FT_LOAD_RENDER) != 0) continue;
            const FT_GlyphSlot slot = face_->glyph;
            draw(static_cast<int>((pen + 32) >> 6) + slot->bitmap_left, -slot->bitmap_top, slot->bitmap);
            pen += slot->advance.x;
            before = glyph;
        }
    }

private:
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

/// Code points of UTF-8 text; U+FFFD for each byte that is none.
std::u32string decode(const std::string& text) {
    std::u32string result;
    for (std::size_t i = 0; i < text.size();) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t length = lead < 0x80         ? 1
                                   : (lead >> 5) == 6  ? 2
                                   : (lead >> 4) == 14 ? 3
                                   : (lead >> 3) == 30 ? 4
                                                       : 0;
        char32_t code = length == 1 ? lead : lead & (0x7Fu >> length);
        bool valid = length > 0 && i + length <= text.size();
        for (std::size_t k = 1; valid && k < length; ++k) {
            const auto next = static_cast<unsigned char>(text[i + k]);
            valid = (next >> 6) == 2;
            code = (code << 6) | (next & 0x3F);
        }
        result.push_back(valid ? code : U'\uFFFD');
        i += valid ? length : 1;
    }
    return result;
}

/// The ink's box about the start of the baseline, y down.
struct Box {
    int left = std::numeric_limits<int>::max(), top = left, right = std::numeric_limits<int>::min(),
        bottom = right;
};

Box ink(Font& font, const std::u32string& text) {
    Box box;
    font.set(text, [&](int left, int top, const FT_Bitmap& glyph) {
        if (glyph.width == 0) return;
        box.left = std::min(box.left, left);
        box.top = std::min(box.top, top);
        box.right = std::max(box.right, left + static_cast<int>(glyph.width));
        box.bottom = std::max(box.bottom, top + static_cast<int>(glyph.rows));
    });
    return box.right < box.left ? Box{0, 0, 0, 0} : box;
}

int start(int x, const Box& box, HorizontalAlign how) {
    if (how == HorizontalAlign::Left) return x - box.left;
    if (how == HorizontalAlign::Right) return x - box.right;
    return x - (box.left + box.right) / 2;
}

int baseline(int y, const Box& box, VerticalAlign how) {
    if (how == VerticalAlign::Baseline) return y;
    if (how == VerticalAlign::Top) return y - box.top;
    if (how == VerticalAlign::Bottom) return y - box.bottom;
    return y - (box.top + box.bottom) / 2;
}

void blend(Image& image, int x, int y, float coverage, const Color& color) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
    float* pixel = image.at(x, y);
    for (int channel = 0; channel < std::min(3, image.channels); ++channel) {
        pixel[channel] += coverage * (color[channel] - pixel[channel]);
    }
}

}  // namespace

TextSize text_size(const std::string& text, const TextStyle& style) {
    Font font(find_font(style), style.size);
    const Box box = ink(font, decode(text));
    return {box.right - box.left, box.bottom - box.top};
}

void draw_text(Image& image, int x, int y, const std::string& text, const TextStyle& style) {
    Font font(find_font(style), style.size);
    const std::u32string characters = decode(text);
    const Box box = ink(font, characters);
    const int x0 = start(x, box, style.horizontal), y0 = baseline(y, box, style.vertical);
    font.set(characters, [&](int left, int top, const FT_Bitmap& glyph) {
        for (int row = 0; row < static_cast<int>(glyph.rows); ++row) {
            for (int column = 0; column < static_cast<int>(glyph.width); ++column) {
                const float coverage = static_cast<float>(glyph.buffer[row * glyph.pitch + column]) / 255.0f;
                blend(image, x0 + left + column, y0 + top + row, coverage, style.color);
            }
        }
    });
}

}  // namespace automorph::render
