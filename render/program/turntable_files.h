#pragma once

#include <filesystem>
#include <string>

#include "render/program/arguments.h"
#include "render/turntable/sequence.h"
#include "render/turntable/stage.h"

/// Which files a turntable is made of, and what each of them depends on.
namespace automorph::program {

/// Where everything goes.
struct TurntableTargets {
    std::filesystem::path pattern;  ///< of the frames
    std::filesystem::path video;    ///< empty: none
};

/// @throws IoError  the extension is none of .png, .exr, .mp4, .webm
TurntableTargets turntable_targets(const std::filesystem::path& out);

/// The frames' files and the record of all that each depends on: contents of the meshes, options, seed,
/// version.
/// @throws IoError      a mesh cannot be read
/// @throws ConfigError  the range of frames is none
turntable::Sequence turntable_sequence(const TurntableArguments& arguments,
                                       const turntable::StageOptions& stage,
                                       const std::filesystem::path& pattern);

/// Removes what killed runs left of the frames that this run is to make, and of the video.
void remove_turntable_leftovers(const turntable::Sequence& sequence, const std::filesystem::path& video);

}  // namespace automorph::program
