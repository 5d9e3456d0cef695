#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "morph/mesh/write_gate.h"
#include "render/film/image.h"

namespace automorph {

/// A picture as a video takes it: 8-bit sRGB, rows from the top.
struct VideoFrame {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

/// @param image  three channels, linear
VideoFrame video_frame(const render::Image& image);

/// Whether the program `ffmpeg` is in the PATH.
bool has_ffmpeg();

/// What ffmpeg is told for a file, by its extension: codec, quality, colours.
std::string encoder_settings(const std::filesystem::path& file);

/// A video while it is made, and what it is then called.
struct VideoFile {
    std::filesystem::path file, aside;
};

/// Writes one video into one or several files by the program ffmpeg: .webm is VP9, all else MP4 with H.264
/// that begins to play while it loads; odd sides get a white pixel more. The files are written aside and
/// renamed by finish(); without it nothing is left, nor when the process is asked to end (write_gate.h), and
/// what a killed process leaves is known to remove_leftovers(). With the same ffmpeg, equal frames give equal
/// files, whatever the machine.
class VideoEncoder {
public:
    /// @throws IoError ffmpeg cannot be started
    VideoEncoder(const std::vector<std::filesystem::path>& files, int width, int height,
                 double frames_per_second);
    ~VideoEncoder();
    VideoEncoder(const VideoEncoder&) = delete;
    VideoEncoder& operator=(const VideoEncoder&) = delete;

    /// @throws IoError with what ffmpeg says, if it has given up
    void add(const VideoFrame& frame);

    /// @throws IoError with what ffmpeg says, or the system where a file cannot be renamed
    void finish();

private:
    int wait() noexcept;
    [[noreturn]] void fail();
    void discard() noexcept;

    std::vector<VideoFile> parts_;
    std::filesystem::path log_;
    int width_, height_;
    int process_ = -1, pipe_ = -1;
    std::optional<UndoneAtEnd> at_end_;
};

}  // namespace automorph
