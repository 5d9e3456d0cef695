#pragma once

#include <map>
#include <string>
#include <vector>

namespace automorph::render {

// What the door `image_file` and the module `image_io` tell each other, and how the module is found.
// OpenImageIO loads some 260 shared libraries, 0.4 s of start-up; so the code that calls it is a shared
// library of its own, which is loaded when the first picture is read or written.

/// What a file says of its picture.
struct PictureHeader {
    enum class Type { Byte, Short, Float };  ///< unsigned 8 and 16 bits, 32-bit float

    int width = 0, height = 0;
    std::vector<std::string> channels;         ///< names, in the order of a pixel's values
    Type type = Type::Float;                   ///< as stored; floats of 16 bits count as Float
    std::map<std::string, std::string> texts;  ///< attributes that are text, by OpenImageIO's names
};

/// The calls of the module. Each throws std::runtime_error with the reason, without the file's name.
struct ImageModule {
    /// The bytes of a file. @param name  tells the format, nothing is written there
    /// @param pixels  rows from the top, values of a pixel together, of header.type
    std::vector<unsigned char> (*encode)(const std::string& name, const PictureHeader& header,
                                         const void* pixels);
    PictureHeader (*read_header)(const std::string& file);
    /// @param pixels  room for width x height x channels values; integers as floats are in [0, 1]
    void (*read_pixels)(const std::string& file, PictureHeader::Type type, void* pixels);
};

/// The module, `../lib/automorph/image_io.so` from the folder of the running program on; loaded by the first
/// call.
/// @throws IoError if it is not there or cannot be loaded
const ImageModule& image_module();

/// Loads the module from a file. @throws IoError as above
const ImageModule& load_image_module(const std::string& file);

}  // namespace automorph::render

/// The only symbol of the module.
extern "C" const automorph::render::ImageModule* automorph_image_module();
