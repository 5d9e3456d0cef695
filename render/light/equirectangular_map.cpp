#include "render/light/equirectangular_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "morph/mesh/errors.h"
#include "render/math/angle.h"

namespace automorph::render {
namespace {

constexpr double kHalfTurn = 3.14159265358979324;

// A cell of a distribution and the place in it.
struct Place {
    int cell;
    double within;  // in [0, 1]
};

// Inverts a distribution of `cells` + 1 rising values from 0 to 1. Cells without probability are never taken.
Place invert(const float* distribution, int cells, float u) {
    const float* above = std::upper_bound(distribution, distribution + cells, u);
    const auto cell = std::min(static_cast<int>(above - distribution), cells) - 1;
    const float low = distribution[cell], high = distribution[cell + 1];
    return {cell, std::min(1.0, static_cast<double>((u - low) / (high - low)))};
}

// Distribution of values in proportion to `weights`; evenly if all are zero.
void accumulate(const std::vector<double>& weights, float* distribution) {
    double sum = 0.0, part = 0.0;
    for (const double w : weights) sum += w;
    distribution[0] = 0.0f;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        part += sum > 0.0 ? weights[i] / sum : 1.0 / static_cast<double>(weights.size());
        distribution[i + 1] = static_cast<float>(std::min(1.0, part));
    }
    // The end is reached by the last cell that has a weight, so that numbers near one do not fall beyond it.
    for (std::size_t i = weights.size(); i > 0 && (i == weights.size() || weights[i] == 0.0); --i)
        distribution[i] = 1.0f;
}

}  // namespace

EquirectangularMap::EquirectangularMap(const Image& image, const MapAxes& axes)
    : axes_(axes), width_(image.width), height_(image.height) {
    if (width_ <= 0 || height_ <= 0 || (image.channels != 1 && image.channels != 3)) {
        throw ConfigError(
            fmt::format("sky: the picture has {} x {} pixels and {} channels; expected one or three channels",
                        width_, height_, image.channels));
    }
    const auto width = static_cast<std::size_t>(width_), height = static_cast<std::size_t>(height_);
    texels_.reserve(3 * width * height);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float x = image.pixels[i];
        if (!(x >= 0.0f && std::isfinite(x))) {
            const std::size_t pixel = i / static_cast<std::size_t>(image.channels);
            throw ConfigError(fmt::format("sky: pixel ({}, {}) is {}; expected a radiance", pixel % width,
                                          pixel / width, x));
        }
        texels_.insert(texels_.end(), image.channels == 1 ? 3 : 1, x);
    }
    for (int row = 0; row <= height_; ++row)
        edges_.push_back(sine_and_cosine(kHalfTurn * row / height_).cosine);

    rows_.resize(height + 1);
    columns_.resize(height * (width + 1));
    std::vector<double> row_weights(height), weights(width);
    for (std::size_t row = 0; row < height; ++row) {
        for (std::size_t column = 0; column < width; ++column) {
            weights[column] =
                static_cast<double>(color(row * width + column).mean()) * solid_angle(static_cast<int>(row));
            row_weights[row] += weights[column];
        }
        accumulate(weights, &columns_[row * (width + 1)]);
        power_ += row_weights[row];
    }
    accumulate(row_weights, rows_.data());
}

double EquirectangularMap::solid_angle(int row) const {
    const auto r = static_cast<std::size_t>(row);
    return 2.0 * kHalfTurn / width_ * (edges_[r] - edges_[r + 1]);
}

std::size_t EquirectangularMap::texel(const Vec3& direction) const {
    const auto x = static_cast<double>(direction.dot(axes_.middle)),
               y = static_cast<double>(direction.dot(axes_.left));
    const double polar = angle_of(std::sqrt(x * x + y * y), static_cast<double>(direction.dot(axes_.zenith)));
    const double azimuth = std::copysign(angle_of(std::abs(y), x), -y);
    const int row = static_cast<int>(polar / kHalfTurn * height_);
    const int column = static_cast<int>((0.5 * azimuth / kHalfTurn + 0.5) * width_);
    return static_cast<std::size_t>(std::clamp(row, 0, height_ - 1)) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(std::clamp(column, 0, width_ - 1));
}

std::optional<LightSample> EquirectangularMap::sample(float u, float v) const {
    if (!(power_ > 0.0)) return std::nullopt;
    const Place down = invert(rows_.data(), height_, v);
    const auto row = static_cast<std::size_t>(down.cell), width = static_cast<std::size_t>(width_);
    const Place right = invert(&columns_[row * (width + 1)], width_, u);
    const double z = edges_[row] + down.within * (edges_[row + 1] - edges_[row]);
    const SineCosine azimuth =
        sine_and_cosine(2.0 * kHalfTurn * ((right.cell + right.within) / width_ - 0.5));
    const double level = std::sqrt(std::max(0.0, 1.0 - z * z));
    const Vec3 local = Eigen::Vector3d(azimuth.cosine * level, -azimuth.sine * level, z).cast<float>();
    const Vec3 wi = local.x() * axes_.middle + local.y() * axes_.left + local.z() * axes_.zenith;
    const Color radiance = color(row * width + static_cast<std::size_t>(right.cell));
    return LightSample{wi, wi, radiance, density(radiance), std::numeric_limits<float>::infinity()};
}

// Texels are small, so that the cosine at their middle stands for them.
Color EquirectangularMap::irradiance(const Vec3& normal) const {
    const Eigen::Vector3d n =
        Vec3(normal.dot(axes_.middle), normal.dot(axes_.left), normal.dot(axes_.zenith)).cast<double>();
    Eigen::Array3d sum = Eigen::Array3d::Zero();
    for (int row = 0; row < height_; ++row) {
        const auto r = static_cast<std::size_t>(row);
        const double z = 0.5 * (edges_[r] + edges_[r + 1]), level = std::sqrt(std::max(0.0, 1.0 - z * z));
        for (int column = 0; column < width_; ++column) {
            const SineCosine azimuth = sine_and_cosine(2.0 * kHalfTurn * ((column + 0.5) / width_ - 0.5));
            const double cosine = n.dot(Eigen::Vector3d(azimuth.cosine * level, -azimuth.sine * level, z));
            if (cosine <= 0.0) continue;
            const Color c = color(r * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column));
            sum += cosine * solid_angle(row) * c.cast<double>();
        }
    }
    return sum.cast<float>();
}

}  // namespace automorph::render
