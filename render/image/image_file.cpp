#include "render/image/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"
#include "render/image/data_uri.h"
#include "render/image/image_module.h"

namespace automorph::render {
namespace {

namespace fs = std::filesystem;
using Type = PictureHeader::Type;

PictureHeader make_header(const fs::path& file, const Image& image, Type type, const Metadata& metadata) {
    if (image.width <= 0 || image.height <= 0 || (image.channels != 1 && image.channels != 3)) {
        throw IoError(
            fmt::format("{}: a picture of {} x {} pixels with {} channels cannot be written; give one or "
                        "three channels",
                        file.string(), image.width, image.height, image.channels));
    }
    PictureHeader header{image.width, image.height, {"Y"}, type, metadata};
    if (image.channels == 3) header.channels = {"R", "G", "B"};
    header.texts["DateTime"] = "";  // else OpenImageIO writes the time of day
    return header;
}

/// The bytes of a picture file. @param file  tells the format; nothing is written there
std::vector<unsigned char> encoded(const fs::path& file, const PictureHeader& header, const void* pixels) {
    const ImageModule& module = image_module();
    try {
        return module.encode(file.string(), header, pixels);
    } catch (const std::runtime_error& error) {
        throw IoError(fmt::format("{}: cannot write the picture: {}", file.string(), error.what()));
    }
}

std::string_view as_text(const std::vector<unsigned char>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Encodes in memory first: OpenImageIO does not notice every failure of a disk.
void write(const fs::path& file, const PictureHeader& header, const void* pixels) {
    write_file(file, as_text(encoded(file, header, pixels)));
}

PictureHeader header_of(const fs::path& file) {
    const ImageModule& module = image_module();
    try {
        return module.read_header(file.string());
    } catch (const std::runtime_error& error) {
        throw IoError(fmt::format("{}: cannot read the picture: {}", file.string(), error.what()));
    }
}

/// The place of a channel in a pixel, or -1.
int channel_index(const PictureHeader& header, const std::string& name) {
    const auto found = std::find(header.channels.begin(), header.channels.end(), name);
    return found == header.channels.end() ? -1 : static_cast<int>(found - header.channels.begin());
}

// Which channels of the file are the picture's: R, G, B by name, else the first one or three.
std::vector<int> picture_channels(const PictureHeader& header) {
    const std::vector<int> rgb{channel_index(header, "R"), channel_index(header, "G"),
                               channel_index(header, "B")};
    if (std::none_of(rgb.begin(), rgb.end(), [](int c) { return c < 0; })) return rgb;
    if (header.channels.size() >= 3) return {0, 1, 2};
    return {0};
}

bool has_layers(const PictureHeader& header, const std::vector<std::vector<std::string>>& layers) {
    return std::all_of(layers.begin(), layers.end(), [&](const std::vector<std::string>& names) {
        return std::all_of(names.begin(), names.end(),
                           [&](const std::string& name) { return channel_index(header, name) >= 0; });
    });
}

template <class T, class Convert>
Image read_pixels(const fs::path& file, const PictureHeader& header, const std::vector<int>& channels,
                  Type type, const Convert& convert) {
    const std::size_t all = header.channels.size();
    std::vector<T> raw(static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) *
                       all);
    try {
        image_module().read_pixels(file.string(), type, raw.data());
    } catch (const std::runtime_error& error) {
        throw IoError(fmt::format("{}: cannot read the pixels: {}", file.string(), error.what()));
    }
    Image image(header.width, header.height, static_cast<int>(channels.size()));
    std::size_t next = 0;
    for (std::size_t pixel = 0; pixel < raw.size(); pixel += all) {
        for (int c : channels) image.pixels[next++] = convert(raw[pixel + static_cast<std::size_t>(c)]);
    }
    return image;
}

Image read_floats(const fs::path& file, const PictureHeader& header, const std::vector<int>& channels) {
    return read_pixels<float>(file, header, channels, Type::Float, [](float value) { return value; });
}

}  // namespace

void write_exr(const fs::path& file, const Image& image, const Metadata& metadata) {
    PictureHeader header = make_header(file, image, Type::Float, metadata);
    header.texts["compression"] = "zip";
    write(file, header, image.pixels.data());
}

void write_exr(const fs::path& file, const Image& image, const Layers& layers, const Metadata& metadata) {
    struct Part {
        const Image& image;
        std::vector<std::string> channels;
    };
    const auto names = [](const std::string& layer, const char* letters) {
        std::vector<std::string> channels;
        for (const char* c = letters; *c != 0; ++c) channels.push_back(layer + "." + *c);
        return channels;
    };
    const std::vector<Part> parts{{image, {"R", "G", "B"}},
                                  {layers.albedo, names("albedo", "RGB")},
                                  {layers.shading_normal, names("shading_normal", "XYZ")},
                                  {layers.geometric_normal, names("geometric_normal", "XYZ")},
                                  {layers.depth, names("depth", "Z")},
                                  {layers.position, names("position", "XYZ")},
                                  {layers.object, {"object.id"}},
                                  {layers.face, {"face.id"}},
                                  {layers.variance, names("variance", "RGB")},
                                  {layers.samples, {"samples.count"}}};
    PictureHeader header = make_header(file, image, Type::Float, metadata);
    header.channels.clear();
    for (const Part& part : parts) {
        if (part.image.width != image.width || part.image.height != image.height ||
            part.image.channels != static_cast<int>(part.channels.size())) {
            throw IoError(
                fmt::format("{}: layer {} has {} x {} pixels and {} channels; expected {} x {} and {}",
                            file.string(), part.channels.front(), part.image.width, part.image.height,
                            part.image.channels, image.width, image.height, part.channels.size()));
        }
        header.channels.insert(header.channels.end(), part.channels.begin(), part.channels.end());
    }
    header.texts["compression"] = "zip";
    std::vector<float> pixels;
    pixels.reserve(header.channels.size() * image.pixels.size() / 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (const Part& part : parts)
                pixels.insert(pixels.end(), part.image.at(x, y), part.image.at(x, y) + part.image.channels);
        }
    }
    write(file, header, pixels.data());
}

void write_png(const fs::path& file, const Image& image, const Metadata& metadata,
               const PngOptions& options) {
    if (options.bits != 8 && options.bits != 16)
        throw IoError(fmt::format("{}: PNG of {} bits; expected 8 or 16", file.string(), options.bits));
    PictureHeader header = make_header(file, image, options.bits == 8 ? Type::Byte : Type::Short, metadata);
    header.texts["oiio:ColorSpace"] = "sRGB";
    std::vector<float> linear = image.pixels;
    if (options.curve == ToneCurve::Filmic)
        std::transform(linear.begin(), linear.end(), linear.begin(), filmic);
    if (options.bits == 8) {
        std::vector<std::uint8_t> codes(linear.size());
        std::transform(linear.begin(), linear.end(), codes.begin(), to_srgb8);
        write(file, header, codes.data());
    } else {
        std::vector<std::uint16_t> codes(linear.size());
        std::transform(linear.begin(), linear.end(), codes.begin(), to_srgb16);
        write(file, header, codes.data());
    }
}

std::string jpeg_data_uri(const Image& image, int quality) {
    const fs::path name = "picture.jpg";
    PictureHeader header = make_header(name, image, Type::Byte, {});
    header.texts["Compression"] = fmt::format("jpeg:{}", quality);
    header.texts["jpeg:subsampling"] = "4:4:4";
    std::vector<std::uint8_t> codes(image.pixels.size());
    std::transform(image.pixels.begin(), image.pixels.end(), codes.begin(), to_srgb8);
    const std::vector<unsigned char> bytes = encoded(name, header, codes.data());
    return data_uri("image/jpeg", as_text(bytes));
}

ImageFile read_image(const fs::path& file) {
    const PictureHeader header = header_of(file);
    const std::vector<int> channels = picture_channels(header);
    ImageFile result{{}, header.texts};
    switch (header.type) {
        case Type::Byte:
            result.image = read_pixels<std::uint8_t>(file, header, channels, Type::Byte, from_srgb8);
            break;
        case Type::Short:
            result.image =
                read_pixels<std::uint16_t>(file, header, channels, Type::Short,
                                           [](std::uint16_t code) { return from_srgb(code / 65535.0); });
            break;
        case Type::Float:
            result.image = read_floats(file, header, channels);
            break;
    }
    return result;
}

std::vector<std::string> channel_names(const fs::path& file) {
    return header_of(file).channels;
}

Image read_channels(const fs::path& file, const std::vector<std::string>& names) {
    const PictureHeader header = header_of(file);
    std::vector<int> channels;
    for (const std::string& name : names) {
        const int channel = channel_index(header, name);
        if (channel < 0) throw IoError(fmt::format("{}: there is no channel {}", file.string(), name));
        channels.push_back(channel);
    }
    return read_floats(file, header, channels);
}

std::optional<std::vector<Image>> read_layers(const fs::path& file,
                                              std::vector<std::vector<std::string>> layers,
                                              const std::vector<std::vector<std::string>>& wanted) {
    const PictureHeader header = header_of(file);
    if (!has_layers(header, layers)) return {};
    if (has_layers(header, wanted)) layers.insert(layers.end(), wanted.begin(), wanted.end());
    std::vector<int> channels;
    for (const std::vector<std::string>& names : layers) {
        for (const std::string& name : names) channels.push_back(channel_index(header, name));
    }
    const Image all = read_floats(file, header, channels);
    std::vector<Image> images;
    std::size_t first = 0;
    for (const std::vector<std::string>& names : layers) {
        Image image(all.width, all.height, static_cast<int>(names.size()));
        auto place = image.pixels.begin();
        for (std::size_t pixel = first; pixel < all.pixels.size(); pixel += channels.size())
            place = std::copy_n(all.pixels.begin() + static_cast<std::ptrdiff_t>(pixel), names.size(), place);
        images.push_back(std::move(image));
        first += names.size();
    }
    return images;
}

}  // namespace automorph::render
