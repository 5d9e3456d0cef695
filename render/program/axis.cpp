#include "render/program/axis.h"

#include <fmt/format.h>

#include <cmath>
#include <locale>
#include <sstream>

#include "morph/mesh/errors.h"

namespace automorph::program {
namespace {

bool read_numbers(const std::string& text, Eigen::Vector3d& axis) {
    std::istringstream stream(text);
    stream.imbue(std::locale::classic());
    char comma = ',';
    for (int k = 0; k < 3; ++k) {
        if (k > 0 && (!(stream >> comma) || comma != ',')) return false;
        if (!(stream >> axis[k])) return false;
    }
    return stream.eof() || (stream >> std::ws).eof();
}

}  // namespace

Eigen::Vector3d parse_axis(const std::string& text) {
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    const bool is_negative = !text.empty() && text.front() == '-';
    const std::string letter = text.substr(is_negative ? 1 : 0);
    if (letter == "x" || letter == "y" || letter == "z") {
        axis[letter.front() - 'x'] = is_negative ? -1 : 1;
        return axis;
    }
    if (!read_numbers(text, axis) || !axis.allFinite() || !(axis.norm() > 0)) {
        throw ConfigError(
            fmt::format("axis '{}': expected x, y, z, -x, -y, -z or three numbers such as 0,1,0.5", text));
    }
    return axis.normalized();
}

Eigen::Vector3d usual_view(const Eigen::Vector3d& up) {
    constexpr double kMostlyY = 0.8;  // the cosine beyond which y is what is up
    if (std::abs(up.y()) > kMostlyY * up.norm()) return {0, 0, -1};
    return {0, 1, 0};
}

}  // namespace automorph::program
