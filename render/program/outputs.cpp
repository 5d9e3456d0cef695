#include "render/program/outputs.h"

#include <fmt/format.h>

#include <set>

#include "morph/mesh/errors.h"

namespace automorph::program {
namespace {

namespace fs = std::filesystem;

/// One name per file, whatever way leads to it.
std::set<fs::path> places(const std::vector<fs::path>& files) {
    std::set<fs::path> result;
    for (const fs::path& file : files) {
        std::error_code ignored;
        if (!file.empty()) result.insert(fs::weakly_canonical(file, ignored));
    }
    return result;
}

}  // namespace

void check_outputs(const std::vector<fs::path>& written, const std::vector<fs::path>& read) {
    const std::set<fs::path> inputs = places(read);
    std::set<fs::path> outputs;
    for (const fs::path& file : written) {
        std::error_code ignored;
        if (file.empty() || fs::is_character_file(file, ignored)) continue;
        const fs::path place = fs::weakly_canonical(file, ignored);
        if (inputs.count(place) > 0)
            throw IoError(fmt::format("{}: is read, and would be overwritten", file.string()));
        if (!outputs.insert(place).second)
            throw IoError(fmt::format("{}: would be written twice", file.string()));
    }
}

}  // namespace automorph::program
