#include "render/geometry/triangle_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "morph/mesh/errors.h"

namespace automorph::render {
namespace {

using Vec3d = Eigen::Vector3d;

// Rays start this many times the largest coordinate off the surface. A point on a triangle is rounded by up
// to 2^-22 of it, and Embree's triangle test errs by as much again.
constexpr float kRayOffset = 0x1p-20f;

std::vector<float> to_floats(const Points& V, std::size_t padding) {
    std::vector<float> out(static_cast<std::size_t>(V.size()) + padding, 0.0f);
    std::transform(V.data(), V.data() + V.size(), out.begin(),
                   [](double x) { return static_cast<float>(x); });
    return out;
}

float largest_coordinate(const std::vector<float>& positions) {
    float largest = 0.0f;
    for (float x : positions) {
        if (std::isfinite(x)) largest = std::max(largest, std::abs(x));
    }
    return largest;
}

// Those without a direction become the zero vector.
Points with_unit_rows(Points normals) {
    for (Eigen::Index i = 0; i < normals.rows(); ++i) {
        const double length = normals.row(i).norm();
        if (length > 0.0 && std::isfinite(length)) {
            normals.row(i) /= length;
        } else {
            normals.row(i).setZero();
        }
    }
    return normals;
}

std::vector<float> unit_normals(Points normals) {
    return to_floats(with_unit_rows(std::move(normals)), 0);
}

// Unit vertex normals, each triangle weighted by its area: the needles of merged meshes, whose own normals
// are rounding, do not count. Vertices without one get the zero vector.
Points area_weighted_normals(const Points& V, const std::vector<std::uint32_t>& indices) {
    Points sums = Points::Zero(V.rows(), 3);
    for (std::size_t f = 0; f + 2 < indices.size(); f += 3) {
        const std::array<Vec3d, 3> p{V.row(indices[f]), V.row(indices[f + 1]), V.row(indices[f + 2])};
        const Vec3d area_normal = cross(Vec3d(p[1] - p[0]), Vec3d(p[2] - p[0]));
        if (!area_normal.allFinite()) continue;
        for (std::size_t k = 0; k < 3; ++k) sums.row(indices[f + k]) += area_normal;
    }
    return with_unit_rows(std::move(sums));
}

}  // namespace

TriangleMesh::TriangleMesh(const Points& V, const Triangles& F, Normals normals, const Points& vertex_normals,
                           int time_steps)
    : positions_(static_cast<std::size_t>(std::max(1, time_steps))),
      indices_(static_cast<std::size_t>(F.size())),
      smooth_(normals == Normals::Smooth) {
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        for (Eigen::Index k = 0; k < 3; ++k) {
            if (F(f, k) < 0 || F(f, k) >= V.rows()) {
                throw InvalidMesh(fmt::format("triangle {} has vertex index {}, but there are {} vertices", f,
                                              F(f, k), V.rows()));
            }
            indices_[static_cast<std::size_t>(3 * f + k)] = static_cast<std::uint32_t>(F(f, k));
        }
    }
    if (vertex_normals.rows() != 0) {
        if (vertex_normals.rows() != V.rows()) {
            throw InvalidMesh(
                fmt::format("{} vertex normals are given for {} vertices", vertex_normals.rows(), V.rows()));
        }
        given_normals_ = true;
        if (smooth_) normals_ = {unit_normals(vertex_normals)};
    }
    for (std::vector<float>& step : positions_) step.resize(static_cast<std::size_t>(V.size()) + kPadding);
    move(std::vector<Points>(positions_.size(), V));
}

void TriangleMesh::move(const std::vector<Points>& steps) {
    if (steps.size() != positions_.size()) {
        throw InvalidMesh(
            fmt::format("a frame has {} time steps, the mesh has {}", steps.size(), positions_.size()));
    }
    for (const Points& V : steps) {
        if (V.rows() != vertex_count()) {
            throw InvalidMesh(
                fmt::format("a frame has {} vertices, the mesh has {}", V.rows(), vertex_count()));
        }
    }
    const bool follow = smooth_ && !given_normals_;
    if (follow) normals_.clear();
    float largest = 0.0f;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        // In place: Embree reads this memory.
        const std::vector<float> moved = to_floats(steps[i], kPadding);
        std::copy(moved.begin(), moved.end(), positions_[i].begin());
        largest = std::max(largest, largest_coordinate(positions_[i]));
        if (!follow) continue;
        Points normals = area_weighted_normals(steps[i], indices_);
        if (!corrections_.empty() && corrections_[i].rows() != 0) normals += corrections_[i];
        normals_.push_back(unit_normals(std::move(normals)));
    }
    ray_offset_ = kRayOffset * largest;
}

void TriangleMesh::correct_normals(const std::vector<Points>& steps) {
    if (!steps.empty() && steps.size() != positions_.size()) {
        throw InvalidMesh(fmt::format("corrections of normals are given for {} time steps, the mesh has {}",
                                      steps.size(), positions_.size()));
    }
    for (const Points& corrections : steps) {
        if (corrections.rows() != 0 && corrections.rows() != vertex_count()) {
            throw InvalidMesh(fmt::format("{} corrections of normals are given for {} vertices",
                                          corrections.rows(), vertex_count()));
        }
    }
    corrections_ = steps;
}

void TriangleMesh::color(const Points& colors) {
    if (colors.rows() != 0 && colors.rows() != vertex_count()) {
        throw InvalidMesh(
            fmt::format("{} vertex colours are given for {} vertices", colors.rows(), vertex_count()));
    }
    colors_ = to_floats(colors, 0);
}

std::array<Vec3, 3> TriangleMesh::blend(const std::vector<std::vector<float>>& steps, std::uint32_t triangle,
                                        float time) const {
    const auto last = static_cast<float>(steps.size() - 1);
    const float place = std::clamp(time, 0.0f, 1.0f) * last;
    const float before = std::min(std::floor(place), last - 1.0f);
    const auto step = static_cast<std::size_t>(before);
    std::array<Vec3, 3> a = gather(steps[step], triangle);
    const std::array<Vec3, 3> b = gather(steps[step + 1], triangle);
    for (std::size_t k = 0; k < 3; ++k) a[k] += (place - before) * (b[k] - a[k]);
    return a;
}

}  // namespace automorph::render
