#include "morph/mesh/write_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "morph/mesh/errors.h"

namespace automorph {

void write_file(const std::filesystem::path& file, std::string_view bytes) {
    std::filesystem::path aside = file;
    aside += fmt::format(".{}.part", static_cast<long>(getpid()));
    std::error_code error;
    std::ofstream out(aside, std::ios::binary | std::ios::trunc);
    if (!out) {
        throw IoError(fmt::format("{}: cannot be written: {}; check that its folder exists and is writable",
                                  file.string(), std::strerror(errno)));
    }
    errno = 0;
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) {
        const int reason = errno;
        std::filesystem::remove(aside, error);
        throw IoError(fmt::format("{}: cannot be written: {}", file.string(),
                                  reason != 0 ? std::strerror(reason) : "the disk may be full"));
    }
    std::filesystem::rename(aside, file, error);
    if (error) {
        const std::string reason = error.message();
        std::filesystem::remove(aside, error);
        throw IoError(fmt::format("{}: cannot be written: {}", file.string(), reason));
    }
}

}  // namespace automorph
