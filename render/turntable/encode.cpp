#include "render/turntable/encode.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"
#include "morph/mesh/write_gate.h"

namespace automorph::turntable {

namespace fs = std::filesystem;

namespace {

bool is_webm(const fs::path& video) {
    return video.extension() == ".webm";
}

// One thread and no version or date in the file: the same bytes from the same frames.
std::vector<std::string> codec(const fs::path& video) {
    std::vector<std::string> words =
        is_webm(video)
            ? std::vector<std::string>{"-c:v",      "libvpx-vp9", "-crf",      "28", "-b:v", "0",
                                       "-deadline", "good",       "-cpu-used", "2",  "-f",   "webm"}
            : std::vector<std::string>{"-c:v", "libx264",   "-preset",    "medium", "-crf",
                                       "18",   "-movflags", "+faststart", "-f",     "mp4"};
    // Players want even sizes, subsampled colour and the colours' meaning.
    for (const char* word :
         {"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white,scale=out_color_matrix=bt709:out_range=tv",
          "-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709",
          "-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"})
        words.emplace_back(word);
    return words;
}

struct Outcome {
    int status = -1;  // of the exit; -1: killed or not started
    std::string messages;
};

/// Runs a program with its stderr read and no stdin.
Outcome run(const std::vector<std::string>& words) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return {-1, std::strerror(errno)};
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    pid_t process = 0;
    const int failed =
        ::posix_spawnp(&process, arguments.front(), &actions, nullptr, arguments.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    Outcome outcome;
    if (failed != 0) {
        outcome.messages = std::strerror(failed);
    } else {
        char buffer[4096];
        ssize_t count = 0;
        while ((count = ::read(ends[0], buffer, sizeof buffer)) > 0 || (count < 0 && errno == EINTR)) {
            if (count > 0) outcome.messages.append(buffer, static_cast<std::size_t>(count));
        }
        int status = 0;
        while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {
        }
        if (WIFEXITED(status)) outcome.status = WEXITSTATUS(status);
    }
    ::close(ends[0]);
    return outcome;
}

}  // namespace

bool can_encode() {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (::access((fs::path(folder) / "ffmpeg").c_str(), X_OK) == 0) return true;
    }
    return false;
}

std::string encoder_settings(const fs::path& video, const VideoOptions& options) {
    std::string text = fmt::format("{} frames at {} fps", options.frames, options.fps);
    for (const std::string& word : codec(video)) text += " " + word;
    return text;
}

void encode_video(const fs::path& video, const std::string& pattern, const VideoOptions& options) {
    const UnbrokenWrite whole;
    const fs::path aside = name_aside(video);
    std::vector<std::string> words{
        "ffmpeg",        "-y", "-loglevel", "error", "-framerate", fmt::format("{}", options.fps),
        "-start_number", "0",  "-i",        pattern, "-frames:v",  std::to_string(options.frames)};
    for (const std::string& word : codec(video)) words.push_back(word);
    // As a URL: a name with a colon would be taken for a protocol.
    words.push_back("file:" + aside.string());
    const Outcome outcome = run(words);
    std::error_code error;
    if (outcome.status != 0) {
        fs::remove(aside, error);
        std::string reason = outcome.messages.substr(0, outcome.messages.find('\n'));
        if (reason.empty()) reason = "ffmpeg did not finish";
        throw IoError(fmt::format("{}: ffmpeg cannot make the video: {}", video.string(), reason));
    }
    fs::rename(aside, video, error);
    if (error) {
        const std::string reason = error.message();
        fs::remove(aside, error);
        throw IoError(fmt::format("{}: cannot be written: {}", video.string(), reason));
    }
}

}  // namespace automorph::turntable
