#pragma once

#include <filesystem>
#include <string>

#include "render/film/image.h"

namespace automorph::turntable {

/// Writes a frame as EXR or PNG by its extension, aside and then renamed, with a record in it: `inputs`, word
/// for word, and a hash of the pixels.
/// @param inputs  all that the frame depends on, ASCII
/// @throws IoError naming the file and the system's reason; an existing file stays as it was
void write_frame(const std::filesystem::path& file, const render::Image& image, const std::string& inputs);

/// What is known of a frame on disk.
enum class FrameState {
    Missing,
    Damaged,   ///< no picture, not whole, or without a record
    Outdated,  ///< made from other inputs
    Finished
};

/// Reads the whole file: a frame is finished if it was made from these inputs and every pixel is as it was
/// written.
FrameState frame_state(const std::filesystem::path& file, const std::string& inputs);

/// "missing", "damaged", "made from other inputs", "finished".
const char* words(FrameState state);

}  // namespace automorph::turntable
