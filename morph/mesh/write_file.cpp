#include "morph/mesh/write_file.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_gate.h"

namespace automorph {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPart = ".part";

struct Leftover {
    std::string name;  // of the file that was to be
    long process;
};

/// Takes apart what name_aside() made; an empty name for other files.
Leftover parse_aside(std::string_view text) {
    const auto is_digits = [](std::string_view part) {
        return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
    };
    if (text.size() < kPart.size() || text.substr(text.size() - kPart.size()) != kPart) return {};
    text.remove_suffix(kPart.size());
    const std::size_t dash = text.rfind('-'), dot = text.rfind('.');
    if (dash == std::string_view::npos || dot == std::string_view::npos || dash < dot) return {};
    const std::string_view process = text.substr(dot + 1, dash - dot - 1);
    if (!is_digits(process) || !is_digits(text.substr(dash + 1))) return {};
    Leftover result{std::string(text.substr(0, dot)), 0};
    const auto read = std::from_chars(process.data(), process.data() + process.size(), result.process);
    if (read.ec != std::errc()) return {};
    return result;
}

/// Pipes and devices are written as they are: to put a file in the place of /dev/null would break the
/// machine.
bool is_no_file(const fs::path& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

[[noreturn]] void fail(const fs::path& file, const std::string& reason) {
    throw IoError(fmt::format("{}: cannot be written: {}", file.string(), reason));
}

/// @throws IoError about `file`
void write_bytes(const fs::path& place, std::string_view bytes, const fs::path& file) {
    errno = 0;
    std::ofstream out(place, std::ios::binary | std::ios::trunc);
    if (!out) {
        fail(file,
             fmt::format("{}{}", std::strerror(errno), errno == ENOENT ? "; does its folder exist?" : ""));
    }
    errno = 0;
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) fail(file, errno != 0 ? std::strerror(errno) : "the disk may be full");
}

/// A process that is not ours may still write; one of ours has no file aside between two writes.
bool writes_still(long process) {
    if (process == ::getpid()) return false;
    return ::kill(static_cast<pid_t>(process), 0) == 0 || errno != ESRCH;
}

}  // namespace

fs::path name_aside(const fs::path& file) {
    static std::atomic<unsigned> counter{0};
    fs::path aside = file;
    aside += fmt::format(".{}-{}{}", static_cast<long>(::getpid()), counter++, kPart);
    return aside;
}

std::string file_content(const fs::path& file) {
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad() || !stream.is_open() || std::filesystem::is_directory(file)) {
        throw IoError(fmt::format("{}: cannot be read: {}", file.string(),
                                  errno != 0 ? std::strerror(errno) : "it is no file"));
    }
    return bytes;
}

fs::path behind_links(const fs::path& file) {
    constexpr int kMostLinks = 40;  // as Linux follows
    fs::path place = file;
    std::error_code error;
    for (int i = 0; i < kMostLinks && fs::is_symlink(place, error); ++i)
        place = place.parent_path() / fs::read_symlink(place, error);
    if (fs::is_symlink(place, error)) fail(file, "its symbolic links go round in a circle");
    return place;
}

void put_in_place(const fs::path& aside, const fs::path& place) {
    std::error_code error;
    const fs::file_status old = fs::status(place, error);
    if (fs::is_regular_file(old)) {
        // A rename asks the folder only.
        if (::access(place.c_str(), W_OK) != 0) fail(place, std::strerror(errno));
        fs::permissions(aside, old.permissions(), error);
        if (error) fail(place, error.message());
    }
    fs::rename(aside, place, error);
    if (error) fail(place, error.message());
}

void write_file(const fs::path& file, std::string_view bytes) {
    if (is_no_file(file)) {
        write_bytes(file, bytes, file);
        return;
    }
    const UnbrokenWrite whole;
    const fs::path place = behind_links(file), aside = name_aside(place);
    try {
        write_bytes(aside, bytes, file);
        put_in_place(aside, place);
    } catch (const IoError&) {
        std::error_code ignored;
        fs::remove(aside, ignored);
        throw;
    }
}

void make_folder(const fs::path& folder) {
    if (folder.empty()) return;
    std::error_code error;
    fs::create_directories(folder, error);
    if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
    if (!error && ::access(folder.c_str(), W_OK | X_OK) != 0)
        error = std::error_code(errno, std::generic_category());
    if (error) {
        throw IoError(
            fmt::format("{}: cannot be used as output folder: {}", folder.string(), error.message()));
    }
}

void remove_leftovers(const fs::path& folder, const std::function<bool(const std::string& name)>& is_ours) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder.empty() ? fs::path(".") : folder, error)) {
        const Leftover left = parse_aside(entry.path().filename().string());
        if (left.name.empty() || !is_ours(left.name) || writes_still(left.process)) continue;
        std::error_code ignored;
        fs::remove(entry.path(), ignored);
    }
}

}  // namespace automorph
