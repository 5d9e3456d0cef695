#include "render/figure/text_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"

namespace automorph {

namespace fs = std::filesystem;

void write_text_file(const fs::path& file, const std::string& text) {
    write_file(file, text);
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

}  // namespace automorph
