#include "render/image/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"

namespace automorph::render {
namespace {

namespace fs = std::filesystem;

OIIO::ImageSpec make_spec(const fs::path& file, const Image& image, OIIO::TypeDesc type,
                          const Metadata& metadata) {
    if (image.width <= 0 || image.height <= 0 || (image.channels != 1 && image.channels != 3)) {
        throw IoError(
            fmt::format("{}: a picture of {} x {} pixels with {} channels cannot be written; give one or "
                        "three channels",
                        file.string(), image.width, image.height, image.channels));
    }
    OIIO::ImageSpec spec(image.width, image.height, image.channels, type);
    if (image.channels == 1) spec.channelnames = {"Y"};
    spec.attribute("DateTime", "");  // else OpenImageIO writes the time of day
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    return spec;
}

/// The bytes of a picture file. @param file  tells the format; nothing is written there
std::vector<unsigned char> encoded(const fs::path& file, OIIO::ImageSpec spec, OIIO::TypeDesc type,
                                   const void* pixels) {
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    void* proxy = &memory;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto fail = [&](const std::string& why) {
        throw IoError(fmt::format("{}: cannot write the picture: {}", file.string(), why));
    };
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(file.string());
    if (!out) fail(OIIO::geterror());
    if (!out->open(file.string(), spec) || !out->write_image(type, pixels) || !out->close())
        fail(out->geterror());
    return bytes;
}

std::string_view as_text(const std::vector<unsigned char>& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Encodes in memory first: OpenImageIO does not notice every failure of a disk.
void write(const fs::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, const void* pixels) {
    write_file(file, as_text(encoded(file, spec, type, pixels)));
}

// Which channels of the file are the picture's: R, G, B by name, else the first one or three.
std::vector<int> picture_channels(const OIIO::ImageSpec& spec) {
    const std::vector<int> rgb{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
    if (std::none_of(rgb.begin(), rgb.end(), [](int c) { return c < 0; })) return rgb;
    if (spec.nchannels >= 3) return {0, 1, 2};
    return {0};
}

template <class T, class Convert>
Image read_pixels(OIIO::ImageInput& in, const std::vector<int>& channels, OIIO::TypeDesc type,
                  const fs::path& file, const Convert& convert) {
    const OIIO::ImageSpec& spec = in.spec();
    const auto all = static_cast<std::size_t>(spec.nchannels);
    std::vector<T> raw(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) * all);
    if (!in.read_image(0, 0, 0, spec.nchannels, type, raw.data())) {
        throw IoError(fmt::format("{}: cannot read the pixels: {}", file.string(), in.geterror()));
    }
    Image image(spec.width, spec.height, static_cast<int>(channels.size()));
    std::size_t next = 0;
    for (std::size_t pixel = 0; pixel < raw.size(); pixel += all) {
        for (int c : channels) image.pixels[next++] = convert(raw[pixel + static_cast<std::size_t>(c)]);
    }
    return image;
}

std::unique_ptr<OIIO::ImageInput> opened(const fs::path& file, const OIIO::ImageSpec* hints = nullptr) {
    std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(file.string(), hints);
    if (!in) throw IoError(fmt::format("{}: cannot read the picture: {}", file.string(), OIIO::geterror()));
    return in;
}

float as_stored(float value) {
    return value;
}

}  // namespace

void write_exr(const fs::path& file, const Image& image, const Metadata& metadata) {
    OIIO::ImageSpec spec = make_spec(file, image, OIIO::TypeDesc::FLOAT, metadata);
    spec.attribute("compression", "zip");
    write(file, spec, OIIO::TypeDesc::FLOAT, image.pixels.data());
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
    OIIO::ImageSpec spec = make_spec(file, image, OIIO::TypeDesc::FLOAT, metadata);
    spec.channelnames.clear();
    for (const Part& part : parts) {
        if (part.image.width != image.width || part.image.height != image.height ||
            part.image.channels != static_cast<int>(part.channels.size())) {
            throw IoError(
                fmt::format("{}: layer {} has {} x {} pixels and {} channels; expected {} x {} and {}",
                            file.string(), part.channels.front(), part.image.width, part.image.height,
                            part.image.channels, image.width, image.height, part.channels.size()));
        }
        spec.channelnames.insert(spec.channelnames.end(), part.channels.begin(), part.channels.end());
    }
    spec.nchannels = static_cast<int>(spec.channelnames.size());
    spec.attribute("compression", "zip");
    std::vector<float> pixels;
    pixels.reserve(static_cast<std::size_t>(spec.nchannels) * image.pixels.size() / 3);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (const Part& part : parts)
                pixels.insert(pixels.end(), part.image.at(x, y), part.image.at(x, y) + part.image.channels);
        }
    }
    write(file, spec, OIIO::TypeDesc::FLOAT, pixels.data());
}

void write_png(const fs::path& file, const Image& image, const Metadata& metadata,
               const PngOptions& options) {
    if (options.bits != 8 && options.bits != 16)
        throw IoError(fmt::format("{}: PNG of {} bits; expected 8 or 16", file.string(), options.bits));
    const OIIO::TypeDesc type = options.bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
    OIIO::ImageSpec spec = make_spec(file, image, type, metadata);
    spec.attribute("oiio:ColorSpace", "sRGB");
    std::vector<float> linear = image.pixels;
    if (options.curve == ToneCurve::Filmic)
        std::transform(linear.begin(), linear.end(), linear.begin(), filmic);
    if (options.bits == 8) {
        std::vector<std::uint8_t> codes(linear.size());
        std::transform(linear.begin(), linear.end(), codes.begin(), to_srgb8);
        write(file, spec, type, codes.data());
    } else {
        std::vector<std::uint16_t> codes(linear.size());
        std::transform(linear.begin(), linear.end(), codes.begin(), to_srgb16);
        write(file, spec, type, codes.data());
    }
}

std::string jpeg_data_uri(const Image& image, int quality) {
    const fs::path name = "picture.jpg";
    OIIO::ImageSpec spec = make_spec(name, image, OIIO::TypeDesc::UINT8, {});
    spec.attribute("Compression", fmt::format("jpeg:{}", quality));
    spec.attribute("jpeg:subsampling", "4:4:4");
    std::vector<std::uint8_t> codes(image.pixels.size());
    std::transform(image.pixels.begin(), image.pixels.end(), codes.begin(), to_srgb8);
    const std::vector<unsigned char> bytes = encoded(name, spec, OIIO::TypeDesc::UINT8, codes.data());
    return "data:image/jpeg;base64," + OIIO::Strutil::base64_encode(as_text(bytes));
}

ImageFile read_image(const fs::path& file) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored, alpha is dropped
    const std::unique_ptr<OIIO::ImageInput> in = opened(file, &hints);
    const OIIO::ImageSpec spec = in->spec();
    const std::vector<int> channels = picture_channels(spec);
    ImageFile result;
    const auto type = static_cast<OIIO::TypeDesc::BASETYPE>(spec.format.basetype);
    if (type == OIIO::TypeDesc::FLOAT || type == OIIO::TypeDesc::HALF) {
        result.image = read_pixels<float>(*in, channels, OIIO::TypeDesc::FLOAT, file, as_stored);
    } else if (type == OIIO::TypeDesc::UINT8) {
        result.image = read_pixels<std::uint8_t>(*in, channels, OIIO::TypeDesc::UINT8, file, from_srgb8);
    } else if (type == OIIO::TypeDesc::UINT16) {
        result.image =
            read_pixels<std::uint16_t>(*in, channels, OIIO::TypeDesc::UINT16, file,
                                       [](std::uint16_t code) { return from_srgb(code / 65535.0); });
    } else {
        throw IoError(fmt::format("{}: pixels are of type {}; expected 8-bit or 16-bit integers or floats",
                                  file.string(), spec.format.c_str()));
    }
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        if (attribute.type() == OIIO::TypeDesc::STRING) {
            result.metadata[attribute.name().string()] = attribute.get_string();
        }
    }
    return result;
}

std::vector<std::string> channel_names(const fs::path& file) {
    return opened(file)->spec().channelnames;
}

Image read_channels(const fs::path& file, const std::vector<std::string>& names) {
    const std::unique_ptr<OIIO::ImageInput> in = opened(file);
    const OIIO::ImageSpec spec = in->spec();
    std::vector<int> channels;
    for (const std::string& name : names) {
        const int channel = spec.channelindex(name);
        if (channel < 0) throw IoError(fmt::format("{}: there is no channel {}", file.string(), name));
        channels.push_back(channel);
    }
    return read_pixels<float>(*in, channels, OIIO::TypeDesc::FLOAT, file, as_stored);
}

std::optional<std::vector<Image>> read_layers(const fs::path& file,
                                              const std::vector<std::vector<std::string>>& layers) {
    const std::unique_ptr<OIIO::ImageInput> in = opened(file);
    std::vector<int> channels;
    for (const std::vector<std::string>& names : layers) {
        for (const std::string& name : names) channels.push_back(in->spec().channelindex(name));
    }
    if (std::any_of(channels.begin(), channels.end(), [](int channel) { return channel < 0; })) return {};
    const Image all = read_pixels<float>(*in, channels, OIIO::TypeDesc::FLOAT, file, as_stored);
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
