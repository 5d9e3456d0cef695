#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/catch.h"
#include "tests/files.h"

/// What ffmpeg's second program finds in a video: codec, pixels, size, frames.
inline std::string probed(const std::filesystem::path& file) {
    const std::filesystem::path found = file.string() + ".txt";
    const std::string command =
        "ffprobe -v error -count_frames -select_streams v -show_entries "
        "stream=codec_name,pix_fmt,width,height,nb_read_frames -of csv=p=0 '" +
        file.string() + "' >'" + found.string() + "'";
    REQUIRE(std::system(command.c_str()) == 0);
    return content(found);
}

/// For as long as it lives, programs are looked for in this folder only.
class PathOnly {
public:
    explicit PathOnly(const std::filesystem::path& folder) : before_(std::getenv("PATH")) {
        ::setenv("PATH", folder.c_str(), 1);
    }
    ~PathOnly() { ::setenv("PATH", before_.c_str(), 1); }

private:
    std::string before_;
};
