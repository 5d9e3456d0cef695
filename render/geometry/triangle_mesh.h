#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "morph/mesh/mesh.h"
#include "render/math/vec.h"

namespace automorph::render {

enum class Normals {
    Flat,    ///< the triangle's own normal
    Smooth,  ///< interpolated vertex normals, with the shadow offset of [Hanika21] against black terminators
};

/// A mesh as the path tracer reads it: single precision, normals at the vertices if smooth.
class TriangleMesh {
public:
    /// @throws InvalidMesh if an index is out of range, or `vertex_normals` is neither empty nor #V x 3
    TriangleMesh(const Points& V, const Triangles& F, Normals normals, const Points& vertex_normals = {});

    /// New vertices (#V as before); computed normals follow, given ones stay.
    /// @throws InvalidMesh if the number of vertices differs
    void move(const Points& V);

    int vertex_count() const { return static_cast<int>((positions_.size() - kPadding) / 3); }
    int triangle_count() const { return static_cast<int>(indices_.size()) / 3; }
    bool smooth() const { return smooth_; }

    std::array<Vec3, 3> corners(std::uint32_t triangle) const { return gather(positions_, triangle); }
    /// Unit, or zero where there is none. @pre smooth()
    std::array<Vec3, 3> corner_normals(std::uint32_t triangle) const { return gather(normals_, triangle); }

    /// Distance by which rays start off the surface: a few units in the last place of the largest coordinate.
    float ray_offset() const { return ray_offset_; }

    const float* positions() const { return positions_.data(); }  ///< #V x 3, readable one float past the end
    const std::uint32_t* indices() const { return indices_.data(); }  ///< #F x 3

private:
    static constexpr std::size_t kPadding = 1;  // floats after the last vertex: Embree loads 16 bytes at once

    std::array<Vec3, 3> gather(const std::vector<float>& values, std::uint32_t triangle) const {
        const std::uint32_t* corner = &indices_[3 * static_cast<std::size_t>(triangle)];
        const auto row = [&](std::uint32_t i) { return Vec3(&values[3 * static_cast<std::size_t>(i)]); };
        return {row(corner[0]), row(corner[1]), row(corner[2])};
    }

    std::vector<float> positions_;
    std::vector<std::uint32_t> indices_;
    std::vector<float> normals_;  ///< #V x 3, empty if flat
    bool smooth_;
    bool given_normals_ = false;
    float ray_offset_ = 0.0f;
};

}  // namespace automorph::render
