#include "render/video/video_encoder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"
#include "render/image/image_file.h"

namespace automorph {
namespace {

namespace fs = std::filesystem;

bool is_webm(const fs::path& file) {
    return file.extension() == ".webm";
}

std::vector<std::string> split(const std::string& words) {
    std::istringstream stream(words);
    return {std::istream_iterator<std::string>(stream), {}};
}

/// Frames come as raw RGB on standard input.
std::vector<std::string> arguments_of(const std::vector<VideoFile>& files, int width, int height,
                                      double fps) {
    std::vector<std::string> all =
        split(fmt::format("ffmpeg -hide_banner -nostdin -loglevel error -y -f rawvideo -pixel_format rgb24 "
                          "-video_size {}x{} -framerate {} -i pipe:0",
                          width, height, fps));
    for (const VideoFile& each : files) {
        const std::vector<std::string> settings = split(encoder_settings(each.file));
        all.insert(all.end(), settings.begin(), settings.end());
        // Names that begin with a dash or hold a colon are no options or protocols behind a folder.
        all.push_back(fs::absolute(each.aside).string());
    }
    return all;
}

std::string first_line(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

}  // namespace

VideoFrame video_frame(const render::Image& image) {
    assert(image.channels == 3);
    VideoFrame frame{image.width, image.height, std::vector<std::uint8_t>(image.pixels.size())};
    std::transform(image.pixels.begin(), image.pixels.end(), frame.rgb.begin(), render::to_srgb8);
    return frame;
}

bool has_ffmpeg() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (::access((fs::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return true;
    }
    return false;
}

std::string encoder_settings(const fs::path& file) {
    // One thread each, since the number of threads changes the bits; bitexact leaves out versions. Players
    // want even sides. Colours are those of BT.709, and tagged so, or players guess.
    return std::string(
               "-map 0:v -vf pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,"
               "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int,format=yuv420p "
               "-colorspace bt709 -color_primaries bt709 -color_trc iec61966-2-1 -color_range tv -threads 1 "
               "-fflags +bitexact -flags:v +bitexact ") +
           (is_webm(file) ? "-c:v libvpx-vp9 -crf 28 -b:v 0 -deadline good -cpu-used 3 -row-mt 0 -f webm"
                          : "-c:v libx264 -preset medium -crf 18 -movflags +faststart -f mp4");
}

VideoEncoder::VideoEncoder(const std::vector<fs::path>& files, int width, int height,
                           double frames_per_second)
    : width_(width), height_(height) {
    assert(!files.empty());
    for (const fs::path& file : files) {
        const fs::path place = behind_links(file);
        parts_.push_back({place, name_aside(place)});
    }
    log_ = name_aside(fs::path(files.front()).replace_extension(".log"));
    std::vector<std::string> words = arguments_of(parts_, width, height, frames_per_second);
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);

    // A pair of sockets, not a pipe: writing to one whose reader has gone can be told not to send a signal.
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw IoError(fmt::format("ffmpeg cannot be started: {}", std::strerror(errno)));
    const UnbrokenWrite gate;  // what there is to discard is known before anybody does
    at_end_.emplace([](void* encoder) { static_cast<VideoEncoder*>(encoder)->discard(); }, this);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDIN_FILENO);
    ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC,
                                       0644);
    pid_t process = -1;
    const int error = ::posix_spawnp(&process, "ffmpeg", &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    pipe_ = ends[0];
    if (error != 0) {
        discard();
        throw IoError(fmt::format("ffmpeg cannot be started: {}", std::strerror(error)));
    }
    process_ = process;
}

VideoEncoder::~VideoEncoder() {
    discard();
}

void VideoEncoder::add(const VideoFrame& frame) {
    assert(frame.width == width_ && frame.height == height_);
    for (std::size_t sent = 0; sent < frame.rgb.size();) {
        const ssize_t count = ::send(pipe_, frame.rgb.data() + sent, frame.rgb.size() - sent, MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail();
        sent += static_cast<std::size_t>(count);
    }
}

void VideoEncoder::finish() {
    if (wait() != 0) fail();
    const UnbrokenWrite whole;
    ::unlink(log_.c_str());
    for (const VideoFile& part : parts_) put_in_place(part.aside, part.file);
}

/// Ends the input and waits; the exit status, 0 once it has been waited for.
int VideoEncoder::wait() noexcept {
    if (pipe_ >= 0) ::close(pipe_);
    pipe_ = -1;
    int status = 0;
    while (process_ >= 0 && ::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    return status;
}

void VideoEncoder::fail() {
    const UnbrokenWrite gate;  // an ffmpeg that was discarded at the end of the process is no failure
    wait();
    const std::string said = first_line(log_);
    const std::string file = parts_.front().file.string();
    discard();
    throw IoError(fmt::format("{}: ffmpeg cannot make the video: {}", file,
                              said.empty() ? "it ended without a reason" : said));
}

/// Only calls the system: at the end of the process, inside a signal handler.
void VideoEncoder::discard() noexcept {
    if (process_ >= 0) ::kill(process_, SIGKILL);
    wait();
    for (const VideoFile& part : parts_) ::unlink(part.aside.c_str());
    ::unlink(log_.c_str());
}

}  // namespace automorph
