#include "render/program/frame_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace automorph::program {

std::filesystem::path numbered(const std::filesystem::path& pattern, int index, int count) {
    const int digits = std::max<int>(3, static_cast<int>(std::to_string(count - 1).size()));
    const std::string name =
        fmt::format("{}{:0{}}{}", pattern.stem().string(), index, digits, pattern.extension().string());
    return pattern.parent_path() / name;
}

std::string told_of_further_frames(const std::filesystem::path& pattern, int count) {
    int further = 0;
    std::error_code ignored;
    while (std::filesystem::exists(numbered(pattern, count + further, count), ignored)) ++further;
    if (further == 0) return "";
    return fmt::format("{}{} there, too, of an earlier sequence: not among these {} frames",
                       numbered(pattern, count, count).string(),
                       further > 1 ? fmt::format(" and {} more lie", further - 1) : " lies", count);
}

std::string points_csv(const Points& points) {
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "x,y,z\n");
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        fmt::format_to(std::back_inserter(text), "{},{},{}\n", points(i, 0), points(i, 1), points(i, 2));
    }
    return fmt::to_string(text);
}

}  // namespace automorph::program
