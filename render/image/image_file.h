#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "render/film/image.h"
#include "render/film/layers.h"

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

/// Writes a rendered picture with its layers into one EXR, likewise: the radiance as R G B, then `albedo.R`,
/// `shading_normal.X`, `geometric_normal.X`, `depth.Z`, `position.X`, `object.id`, `face.id`, `variance.R`
/// and `samples.count` with the others of their kind.
/// @throws IoError if the file cannot be written, or the pictures differ in size
void write_exr(const std::filesystem::path& file, const Image& image, const Layers& layers,
               const Metadata& metadata = {});

/// How radiance becomes what a screen shows.
enum class ToneCurve {
    Srgb,   ///< clamped to [0, 1], then the curve of IEC 61966-2-1: what is measured is what is shown
    Filmic  ///< first compressed by x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14) [Narkowicz16]: highlights
            ///< roll off, darks gain contrast
};

struct PngOptions {
    ToneCurve curve = ToneCurve::Srgb;
    int bits = 8;  ///< 8 or 16 per channel
};

/// Writes PNG, likewise.
/// @throws IoError as above, or if the bits are neither 8 nor 16
void write_png(const std::filesystem::path& file, const Image& image, const Metadata& metadata = {},
               const PngOptions& options = {});

/// The picture as a JPEG of full colour resolution, for pages: "data:image/jpeg;base64,...".
/// @param quality  1 to 100
/// @throws IoError as above
std::string jpeg_data_uri(const Image& image, int quality);

/// Reads EXR and HDR as they are, 8-bit and 16-bit PNG through the inverse of the sRGB curve; an alpha
/// channel is dropped, as are layers.
/// @throws IoError if the file is missing, not a picture or of other channels
ImageFile read_image(const std::filesystem::path& file);

/// The names of all channels of a picture, in the file's order, e.g. {"R", "G", "B", "A"}.
/// @throws IoError if the file is missing or not a picture
std::vector<std::string> channel_names(const std::filesystem::path& file);

/// Some channels of a picture as they are, by name, e.g. {"variance.R", "variance.G", "variance.B"}.
/// @throws IoError as above, or if a channel is missing
Image read_channels(const std::filesystem::path& file, const std::vector<std::string>& names);

/// Several groups of channels, each as a picture, from one reading of the file; empty if one of them is
/// missing. Those `wanted` follow if the file has all of them.
/// @throws IoError if the file is missing or not a picture
std::optional<std::vector<Image>> read_layers(const std::filesystem::path& file,
                                              std::vector<std::vector<std::string>> layers,
                                              const std::vector<std::vector<std::string>>& wanted = {});

/// A linear value as 8-bit sRGB: clamped to [0, 1], curve of IEC 61966-2-1, rounded to nearest; NaN is 0.
std::uint8_t to_srgb8(float linear);

/// The same with 16 bits.
std::uint16_t to_srgb16(float linear);

/// The linear value of an sRGB code in [0, 1].
float from_srgb(double code);

/// A value through the filmic curve, still linear.
float filmic(float linear);

/// The linear value of an 8-bit sRGB code.
float from_srgb8(std::uint8_t code);

}  // namespace automorph::render
