#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

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

/// Writes one video twice by the program ffmpeg: STEM.mp4 (H.264, 4:2:0, begins to play while it loads) and
/// STEM.webm (VP9). The files are written aside and renamed by finish(); without it nothing is left. With the
/// same ffmpeg, equal frames give equal files, whatever the machine.
class VideoEncoder {
public:
    /// @pre width and height are even
    /// @throws IoError ffmpeg cannot be started
    VideoEncoder(const std::filesystem::path& stem, int width, int height, double frames_per_second);
    ~VideoEncoder();
    VideoEncoder(const VideoEncoder&) = delete;
    VideoEncoder& operator=(const VideoEncoder&) = delete;

    /// @throws IoError with what ffmpeg says, if it has given up
    void add(const VideoFrame& frame);

    /// @throws IoError with what ffmpeg says, or the system where a file cannot be renamed
    void finish();

private:
    struct Part {
        std::filesystem::path file, aside;
    };
    int wait();
    [[noreturn]] void fail();
    void discard() noexcept;

    std::vector<Part> parts_;
    std::filesystem::path log_;
    int width_, height_;
    int process_ = -1, pipe_ = -1;
};

}  // namespace automorph
