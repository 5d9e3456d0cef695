#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/film/image.h"

namespace automorph::render {

/// Named texts stored with a picture: software, seed, spp, ...
using Metadata = std::map<std::string, std::string>;

struct ImageFile {
    Image image;
    Metadata metadata;  ///< every attribute of the file that is text
};

/// Writes 32-bit float EXR (ZIP), channels R G B or Y. The file is written aside and renamed, so that a
/// reader never sees half of it. Equal pictures and metadata give equal files.
/// @throws IoError if the file cannot be written, or the image has neither one nor three channels
void write_exr(const std::filesystem::path& file, const Image& image, const Metadata& metadata = {});

/// Writes 8-bit PNG through to_srgb8, likewise.
/// @throws IoError
void write_png(const std::filesystem::path& file, const Image& image, const Metadata& metadata = {});

/// Reads EXR as it is and 8-bit PNG through the inverse of the sRGB curve; an alpha channel is dropped.
/// @throws IoError if the file is missing, not a picture or of other channels
ImageFile read_image(const std::filesystem::path& file);

/// A linear value as 8-bit sRGB: clamped to [0, 1], curve of IEC 61966-2-1, rounded to nearest; NaN is 0.
std::uint8_t to_srgb8(float linear);

/// The linear value of an 8-bit sRGB code.
float from_srgb8(std::uint8_t code);

}  // namespace automorph::render
