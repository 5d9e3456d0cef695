#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "render/figure/progress.h"
#include "render/turntable/frame_file.h"
#include "render/turntable/stage.h"

namespace automorph::turntable {

/// A numbered sequence on disk.
struct Sequence {
    std::vector<std::filesystem::path> files;      ///< one per frame
    std::function<std::string(int frame)> inputs;  ///< all that the picture of a frame depends on, ASCII
    int first = 0, last = 0;                       ///< frames to make, both included
};

/// A frame that has to be made, and why.
struct OpenFrame {
    int frame = 0;
    FrameState state = FrameState::Missing;
};

/// What is to be done in the range: frames that are missing, damaged or made from other inputs.
std::vector<OpenFrame> open_frames(const Sequence& sequence);

struct MadeFrame {
    int frame = 0;
    double seconds = 0;
    std::uint64_t rays = 0, bad_samples = 0;
};

/// Pictures and writes frames, one after the other.
/// @param told  called after each frame; may be empty
/// @throws IoError naming the file and the system's reason; frames made before stay
std::vector<MadeFrame> make_frames(Stage& stage, const std::vector<Exposure>& exposures,
                                   const Sequence& sequence, const std::vector<OpenFrame>& frames,
                                   const Progress& progress,
                                   const std::function<void(const MadeFrame&)>& told = {});

/// Reads "A-B" (both included), "A-" (to the end) or "A"; empty is the whole sequence.
/// @returns first and last frame
/// @throws ConfigError if it is none of these, or not within 0 ... count - 1
std::pair<int, int> frame_range(const std::string& text, int count);

}  // namespace automorph::turntable
