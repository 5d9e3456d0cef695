#include "render/film/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace automorph::render {
namespace {

// Every 25th or 26th entry of the map's 256, sRGB codes: between them it is nearly straight.
constexpr std::array<std::array<double, 3>, 11> kViridis{{{0.267, 0.005, 0.329},
                                                          {0.283, 0.141, 0.458},
                                                          {0.254, 0.265, 0.530},
                                                          {0.207, 0.372, 0.553},
                                                          {0.164, 0.471, 0.558},
                                                          {0.128, 0.567, 0.551},
                                                          {0.135, 0.659, 0.518},
                                                          {0.267, 0.749, 0.441},
                                                          {0.478, 0.821, 0.318},
                                                          {0.741, 0.873, 0.150},
                                                          {0.993, 0.906, 0.144}}};

double linear(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

}  // namespace

Color viridis(double value) {
    if (std::isnan(value)) return Color::Constant(0.2f);
    constexpr auto kLast = kViridis.size() - 1;
    const double place = std::clamp(value, 0.0, 1.0) * static_cast<double>(kLast);
    const std::size_t cell = std::min(static_cast<std::size_t>(place), kLast - 1);
    const double share = place - static_cast<double>(cell);
    Color color;
    for (std::size_t c = 0; c < 3; ++c) {
        const double code = (1.0 - share) * kViridis[cell][c] + share * kViridis[cell + 1][c];
        color[static_cast<Eigen::Index>(c)] = static_cast<float>(linear(code));
    }
    return color;
}

Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> viridis_colors(const Eigen::VectorXd& values,
                                                                         double low, double high) {
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> colors(values.size(), 3);
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        const double share = high > low ? (values[i] - low) / (high - low) : 0.5;
        colors.row(i) = viridis(share).matrix().cast<double>().transpose();
    }
    return colors;
}

}  // namespace automorph::render
