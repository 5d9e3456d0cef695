// The module `image_io`: all that calls OpenImageIO's readers and writers.

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <memory>
#include <stdexcept>

#include "render/image/image_module.h"

namespace automorph::render {
namespace {

OIIO::TypeDesc type_of(PictureHeader::Type type) {
    switch (type) {
        case PictureHeader::Type::Byte:
            return OIIO::TypeDesc::UINT8;
        case PictureHeader::Type::Short:
            return OIIO::TypeDesc::UINT16;
        case PictureHeader::Type::Float:
            break;
    }
    return OIIO::TypeDesc::FLOAT;
}

std::vector<unsigned char> encode(const std::string& name, const PictureHeader& header, const void* pixels) {
    const OIIO::TypeDesc type = type_of(header.type);
    OIIO::ImageSpec spec(header.width, header.height, static_cast<int>(header.channels.size()), type);
    spec.channelnames = header.channels;
    for (const auto& [key, text] : header.texts) spec.attribute(key, text);

    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    void* proxy = &memory;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const std::unique_ptr<OIIO::ImageOutput> out = OIIO::ImageOutput::create(name);
    if (!out) throw std::runtime_error(OIIO::geterror());
    if (!out->open(name, spec) || !out->write_image(type, pixels) || !out->close())
        throw std::runtime_error(out->geterror());
    return bytes;
}

std::unique_ptr<OIIO::ImageInput> opened(const std::string& file) {
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);  // colours as stored
    std::unique_ptr<OIIO::ImageInput> in = OIIO::ImageInput::open(file, &hints);
    if (!in) throw std::runtime_error(OIIO::geterror());
    return in;
}

PictureHeader read_header(const std::string& file) {
    const std::unique_ptr<OIIO::ImageInput> in = opened(file);
    const OIIO::ImageSpec& spec = in->spec();
    PictureHeader header;
    header.width = spec.width;
    header.height = spec.height;
    header.channels = spec.channelnames;
    switch (spec.format.basetype) {
        case OIIO::TypeDesc::UINT8:
            header.type = PictureHeader::Type::Byte;
            break;
        case OIIO::TypeDesc::UINT16:
            header.type = PictureHeader::Type::Short;
            break;
        case OIIO::TypeDesc::HALF:
        case OIIO::TypeDesc::FLOAT:
            header.type = PictureHeader::Type::Float;
            break;
        default:
            throw std::runtime_error(std::string("pixels are of type ") + spec.format.c_str() +
                                     "; expected 8-bit or 16-bit integers or floats");
    }
    for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
        if (attribute.type() == OIIO::TypeDesc::STRING)
            header.texts[attribute.name().string()] = attribute.get_string();
    }
    return header;
}

void read_pixels(const std::string& file, PictureHeader::Type type, void* pixels) {
    const std::unique_ptr<OIIO::ImageInput> in = opened(file);
    if (!in->read_image(0, 0, 0, in->spec().nchannels, type_of(type), pixels))
        throw std::runtime_error(in->geterror());
}

}  // namespace
}  // namespace automorph::render

extern "C" __attribute__((visibility("default"))) const automorph::render::ImageModule*
automorph_image_module() {
    using namespace automorph::render;
    static const ImageModule module{encode, read_header, read_pixels};
    return &module;
}
