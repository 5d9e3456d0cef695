#include "render/turntable/frame_file.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/image/content_hash.h"
#include "render/image/image_file.h"

namespace automorph::turntable {
namespace {

constexpr const char* kInputs = "automorph:inputs";
constexpr const char* kPixels = "automorph:pixels";

bool is_png(const std::filesystem::path& file) {
    return file.extension() == ".png";
}

/// Of what the file holds: codes of a PNG, floats of an EXR.
std::string pixel_hash(const std::filesystem::path& file, const render::Image& image) {
    if (!is_png(file)) {
        return render::content_hash(
            {reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size() * sizeof(float)});
    }
    std::vector<std::uint8_t> codes(image.pixels.size());
    std::transform(image.pixels.begin(), image.pixels.end(), codes.begin(), render::to_srgb8);
    return render::content_hash({reinterpret_cast<const char*>(codes.data()), codes.size()});
}

/// Readers do not miss the last bytes of a PNG.
bool ends_whole(const std::filesystem::path& file) {
    constexpr std::string_view kEnd("\0\0\0\0IEND\xae\x42\x60\x82", 12);
    if (!is_png(file)) return true;
    std::ifstream stream(file, std::ios::binary);
    char bytes[kEnd.size()] = {};
    stream.seekg(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
    stream.read(bytes, kEnd.size());
    return stream && std::string_view(bytes, kEnd.size()) == kEnd;
}

}  // namespace

void write_frame(const std::filesystem::path& file, const render::Image& image, const std::string& inputs) {
    const render::Metadata record{
        {"Software", "automorph"}, {kInputs, inputs}, {kPixels, pixel_hash(file, image)}};
    is_png(file) ? render::write_png(file, image, record) : render::write_exr(file, image, record);
}

FrameState frame_state(const std::filesystem::path& file, const std::string& inputs) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return FrameState::Missing;
    if (!ends_whole(file)) return FrameState::Damaged;
    try {
        const render::ImageFile read = render::read_image(file);
        const auto pixels = read.metadata.find(kPixels), recorded = read.metadata.find(kInputs);
        if (pixels == read.metadata.end() || recorded == read.metadata.end()) return FrameState::Damaged;
        if (pixels->second != pixel_hash(file, read.image)) return FrameState::Damaged;
        return recorded->second == inputs ? FrameState::Finished : FrameState::Outdated;
    } catch (const IoError&) {
        return FrameState::Damaged;
    }
}

const char* words(FrameState state) {
    switch (state) {
        case FrameState::Missing:
            return "missing";
        case FrameState::Damaged:
            return "damaged";
        case FrameState::Outdated:
            return "made from other inputs";
        case FrameState::Finished:
            return "finished";
    }
    return "";
}

}  // namespace automorph::turntable
