#include "morph/shapes/marching.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "morph/mesh/errors.h"

namespace automorph {

namespace {

// A crossing keeps this share of its edge clear of both ends, so that no triangle vanishes.
constexpr double kClear = 0.1;

// Corner k of a cube is (k & 1, k >> 1 & 1, k >> 2). Kuhn's tetrahedra: paths from corner 0 to corner 7 along
// the axes, one per order of them; even orders are right-handed, odd ones have two corners swapped.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra{
    {{0, 1, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 6, 4, 7}}};

class Grid {
public:
    Grid(const std::function<double(const Eigen::Vector3d&)>& value, const MarchingOptions& options)
        : low_(options.low), cell_(options.cell) {
        for (int k = 0; k < 3; ++k) {
            size_[static_cast<std::size_t>(k)] =
                static_cast<int>(std::ceil((options.high[k] - options.low[k]) / cell_)) + 1;
        }
        const std::size_t count = index(0, 0, size_[2]);
        values_.resize(count);
        vertices_.assign(8 * count, -1);
        for (int z = 0; z < size_[2]; ++z) {
            for (int y = 0; y < size_[1]; ++y) {
                for (int x = 0; x < size_[0]; ++x) {
                    const double here = values_[index(x, y, z)] = value(position(x, y, z));
                    const bool is_border = x == 0 || y == 0 || z == 0 || x == size_[0] - 1 ||
                                           y == size_[1] - 1 || z == size_[2] - 1;
                    if (is_border && !(here > 0.0)) {
                        const Eigen::Vector3d p = position(x, y, z);
                        throw SolverFailure(fmt::format("the surface leaves its box at ({:g} {:g} {:g})",
                                                        p.x(), p.y(), p.z()));
                    }
                }
            }
        }
    }

    Mesh march() {
        for (int z = 0; z + 1 < size_[2]; ++z) {
            for (int y = 0; y + 1 < size_[1]; ++y) {
                for (int x = 0; x + 1 < size_[0]; ++x) cube(x, y, z);
            }
        }
        if (triangles_.empty()) throw SolverFailure("there is no surface in the box");
        Mesh mesh;
        mesh.V.resize(static_cast<Eigen::Index>(points_.size()), 3);
        for (std::size_t v = 0; v < points_.size(); ++v)
            mesh.V.row(static_cast<Eigen::Index>(v)) = points_[v].transpose();
        mesh.F.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
        for (std::size_t f = 0; f < triangles_.size(); ++f) {
            for (int k = 0; k < 3; ++k)
                mesh.F(static_cast<Eigen::Index>(f), k) = triangles_[f][static_cast<std::size_t>(k)];
        }
        return mesh;
    }

private:
    using Corner = std::array<int, 3>;

    std::size_t index(int x, int y, int z) const {
        return static_cast<std::size_t>(x) +
               static_cast<std::size_t>(size_[0]) *
                   (static_cast<std::size_t>(y) +
                    static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(z));
    }
    Eigen::Vector3d position(int x, int y, int z) const { return low_ + cell_ * Eigen::Vector3d(x, y, z); }

    void cube(int x, int y, int z) {
        std::array<double, 8> f;
        int inside = 0;
        for (int k = 0; k < 8; ++k) {
            f[static_cast<std::size_t>(k)] = values_[index(x + (k & 1), y + (k >> 1 & 1), z + (k >> 2))];
            inside += f[static_cast<std::size_t>(k)] < 0.0;
        }
        if (inside == 0 || inside == 8) return;
        for (const auto& corners : kTetrahedra) tetrahedron(x, y, z, corners, f);
    }

    void tetrahedron(int x, int y, int z, const std::array<int, 4>& c, const std::array<double, 8>& f) {
        std::array<bool, 4> in;
        int count = 0;
        for (std::size_t k = 0; k < 4; ++k) count += in[k] = f[static_cast<std::size_t>(c[k])] < 0.0;
        // Even permutations that bring the corners of the smaller side to the front.
        constexpr std::array<std::array<std::size_t, 4>, 4> kAlone{
            {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};
        constexpr std::array<std::array<std::size_t, 4>, 6> kPairs{
            {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}}};
        const auto vertex = [&](std::size_t a, std::size_t b) { return crossing(x, y, z, c[a], c[b]); };
        if (count == 1 || count == 3) {
            for (const auto& [a, b, d, e] : kAlone) {
                if (in[a] == in[b] || in[a] == in[d] || in[a] == in[e]) continue;
                const int p = vertex(a, b), q = vertex(a, d), r = vertex(a, e);
                triangles_.push_back(in[a] ? std::array{p, q, r} : std::array{p, r, q});
            }
        } else if (count == 2) {
            for (const auto& [a, b, d, e] : kPairs) {
                if (!in[a] || !in[b]) continue;
                const int p = vertex(a, d), q = vertex(a, e), r = vertex(b, e), s = vertex(b, d);
                triangles_.push_back({p, q, r});
                triangles_.push_back({p, r, s});
            }
        }
    }

    /// The vertex on the edge between two corners of a cube; one of them includes the other's bits.
    int crossing(int x, int y, int z, int a, int b) {
        if ((a & b) == b) std::swap(a, b);
        const auto corner = [&](int k) { return Corner{x + (k & 1), y + (k >> 1 & 1), z + (k >> 2)}; };
        const Corner from = corner(a), to = corner(b);
        const std::size_t start = index(from[0], from[1], from[2]);
        int& vertex = vertices_[8 * start + static_cast<std::size_t>(b ^ a)];
        if (vertex < 0) {
            const double f = values_[start], g = values_[index(to[0], to[1], to[2])];
            const double t = std::clamp(f / (f - g), kClear, 1.0 - kClear);
            vertex = static_cast<int>(points_.size());
            points_.push_back((1.0 - t) * position(from[0], from[1], from[2]) +
                              t * position(to[0], to[1], to[2]));
        }
        return vertex;
    }

    Eigen::Vector3d low_;
    double cell_;
    std::array<int, 3> size_{};
    std::vector<double> values_;  // per grid point
    std::vector<int> vertices_;   // per grid point and direction (as corner of a cube), -1: none
    std::vector<Eigen::Vector3d> points_;
    std::vector<std::array<int, 3>> triangles_;
};

}  // namespace

Mesh marching_tetrahedra(const std::function<double(const Eigen::Vector3d&)>& value,
                         const MarchingOptions& options) {
    return Grid(value, options).march();
}

}  // namespace automorph
