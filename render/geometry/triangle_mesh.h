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

/// A mesh as the path tracer reads it: single precision, normals at the vertices if smooth. During the
/// exposure its vertices move in straight lines from one time step to the next.
class TriangleMesh {
public:
    /// @throws InvalidMesh if an index is out of range, or `vertex_normals` is neither empty nor #V x 3
    TriangleMesh(const Points& V, const Triangles& F, Normals normals, const Points& vertex_normals = {},
                 int time_steps = 1);

    /// New vertices (#V as before) for each time step; computed normals follow, given ones stay.
    /// @throws InvalidMesh if the number of vertices or of steps differs
    void move(const std::vector<Points>& steps);

    /// From the next move() on added to the unit normals that are computed, which are normalised again: what
    /// the tessellation does not show of the surface. For each time step #V x 3; none: nothing.
    /// @throws InvalidMesh if their number is neither #V nor 0, or the number of steps differs
    void correct_normals(const std::vector<Points>& steps);

    int time_steps() const { return static_cast<int>(positions_.size()); }

    int vertex_count() const { return static_cast<int>((positions_.front().size() - kPadding) / 3); }
    int triangle_count() const { return static_cast<int>(indices_.size()) / 3; }
    bool smooth() const { return smooth_; }

    /// At a time in [0, 1].
    std::array<Vec3, 3> corners(std::uint32_t triangle, float time = 0.0f) const {
        return time_steps() == 1 ? gather(positions_.front(), triangle) : blend(positions_, triangle, time);
    }
    /// Unit, or zero where there is none; shorter between time steps. @pre smooth()
    std::array<Vec3, 3> corner_normals(std::uint32_t triangle, float time = 0.0f) const {
        return normals_.size() == 1 ? gather(normals_.front(), triangle) : blend(normals_, triangle, time);
    }

    /// Gives every vertex a colour, #V x 3, linear; none take them away.
    /// @throws InvalidMesh if their number is neither #V nor 0
    void color(const Points& colors);
    bool has_colors() const { return !colors_.empty(); }
    /// @pre has_colors()
    std::array<Vec3, 3> corner_colors(std::uint32_t triangle) const { return gather(colors_, triangle); }

    /// Distance by which rays start off the surface: a few units in the last place of the largest coordinate.
    float ray_offset() const { return ray_offset_; }

    /// #V x 3, readable one float past the end.
    const float* positions(int step) const { return positions_[static_cast<std::size_t>(step)].data(); }
    const std::uint32_t* indices() const { return indices_.data(); }  ///< #F x 3

private:
    static constexpr std::size_t kPadding = 1;  // floats after the last vertex: Embree loads 16 bytes at once

    std::array<Vec3, 3> gather(const std::vector<float>& values, std::uint32_t triangle) const {
        const std::uint32_t* corner = &indices_[3 * static_cast<std::size_t>(triangle)];
        const auto row = [&](std::uint32_t i) { return Vec3(&values[3 * static_cast<std::size_t>(i)]); };
        return {row(corner[0]), row(corner[1]), row(corner[2])};
    }

    std::array<Vec3, 3> blend(const std::vector<std::vector<float>>& steps, std::uint32_t triangle,
                              float time) const;

    std::vector<std::vector<float>> positions_;  ///< by time step
    std::vector<std::uint32_t> indices_;
    std::vector<std::vector<float>> normals_;  ///< by time step #V x 3; one if given, none if flat
    std::vector<Points> corrections_;          ///< of normals, by time step #V x 3 or empty; may be none
    std::vector<float> colors_;                ///< #V x 3, may be empty
    bool smooth_;
    bool given_normals_ = false;
    float ray_offset_ = 0.0f;
};

}  // namespace automorph::render
