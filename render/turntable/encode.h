#pragma once

#include <filesystem>
#include <string>

namespace automorph::turntable {

struct VideoOptions {
    double fps = 24;
    int frames = 1;
};

/// Whether the program ffmpeg is found in PATH.
bool can_encode();

/// What encode_video() hands to ffmpeg, for telling whether a video is up to date.
std::string encoder_settings(const std::filesystem::path& video, const VideoOptions& options);

/// Makes an .mp4 (H.264) or .webm (VP9) of numbered PNG frames by ffmpeg, aside and then renamed. The same
/// frames give the same bytes with the same ffmpeg.
/// @param pattern  of the frames, with the digits as "%03d" and '%' as "%%"
/// @throws IoError with ffmpeg's first line, if it fails or is not there
void encode_video(const std::filesystem::path& video, const std::string& pattern,
                  const VideoOptions& options);

}  // namespace automorph::turntable
