#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/mesh.h"

/// Disks built in code for the tests of this folder. Angles in radians; triangles counter-clockwise from +z.
namespace disks {

using automorph::Mesh;
using automorph::Points;

inline Mesh from(const std::vector<Eigen::RowVector3d>& V, const std::vector<Eigen::RowVector3i>& F) {
    Mesh mesh;
    mesh.V.resize(static_cast<Eigen::Index>(V.size()), 3);
    mesh.F.resize(static_cast<Eigen::Index>(F.size()), 3);
    for (std::size_t k = 0; k < V.size(); ++k) mesh.V.row(static_cast<Eigen::Index>(k)) = V[k];
    for (std::size_t k = 0; k < F.size(); ++k) mesh.F.row(static_cast<Eigen::Index>(k)) = F[k];
    return mesh;
}

/// Flat unit disk: a centre and `rings` rings of 6 r vertices; the last one, on the circle at equal angles,
/// is the border (its first vertex is at angle 0). Inner vertices are shifted by up to `jitter` ring widths.
inline Mesh flat(int rings, double jitter = 0.0, unsigned seed = 1) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> shift(-jitter / rings, jitter / rings);
    std::vector<Eigen::RowVector3d> V{{shift(random), shift(random), 0.0}};
    std::vector<Eigen::RowVector3i> F;
    const auto start = [](int r) { return r == 0 ? 0 : 1 + 3 * r * (r - 1); };
    for (int r = 1; r <= rings; ++r) {
        for (int k = 0; k < 6 * r; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / (6 * r),
                         radius = static_cast<double>(r) / rings;
            const bool inner = r < rings;
            V.emplace_back(radius * std::cos(angle) + (inner ? shift(random) : 0.0),
                           radius * std::sin(angle) + (inner ? shift(random) : 0.0), 0.0);
        }
        for (int side = 0; side < 6; ++side) {
            for (int k = 0; k < r; ++k) {
                const auto outer = [&](int i) { return start(r) + (side * r + i) % (6 * r); };
                const auto inner = [&](int i) {
                    return r == 1 ? 0 : start(r - 1) + (side * (r - 1) + i) % (6 * (r - 1));
                };
                F.emplace_back(inner(k), outer(k), outer(k + 1));
                if (k + 1 < r) F.emplace_back(inner(k), outer(k + 1), inner(k + 1));
            }
        }
    }
    return from(V, F);
}

/// The same with a height over the disk, so that it is no longer flat.
inline Mesh dome(int rings, double height, double jitter = 0.2, unsigned seed = 1) {
    Mesh mesh = flat(rings, jitter, seed);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double x = mesh.V(v, 0), y = mesh.V(v, 1);
        mesh.V(v, 2) = height * (1.0 - x * x - y * y + 0.3 * std::sin(3.0 * x) * std::cos(2.0 * y));
    }
    return mesh;
}

/// columns x rows squares, each cut by the same diagonal: two of the four corners are ears.
inline Mesh grid(int columns, int rows) {
    std::vector<Eigen::RowVector3d> V;
    std::vector<Eigen::RowVector3i> F;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) V.emplace_back(x, y, 0.1 * x * y);
    }
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            const int v = y * (columns + 1) + x, w = v + columns + 1;
            F.emplace_back(v, v + 1, w + 1);
            F.emplace_back(v, w + 1, w);
        }
    }
    return from(V, F);
}

/// n vertices, all on the border, joined by a zigzag of chords.
inline Mesh polygon(int n) {
    std::vector<Eigen::RowVector3d> V;
    std::vector<Eigen::RowVector3i> F;
    for (int k = 0; k < n; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / n;
        V.emplace_back(2.0 * std::cos(angle), std::sin(angle), 0.2 * std::cos(2.0 * angle));
    }
    int low = 0, high = n - 1;
    for (bool up = true; high - low > 1; up = !up) {
        if (up) {
            F.emplace_back(low, low + 1, high);
            ++low;
        } else {
            F.emplace_back(low, high - 1, high);
            --high;
        }
    }
    return from(V, F);
}

/// Cone over a loop of points about their mean: every triangle has one border edge.
inline Mesh cone(const Points& loop, double height) {
    std::vector<Eigen::RowVector3d> V;
    std::vector<Eigen::RowVector3i> F;
    const int n = static_cast<int>(loop.rows());
    for (int k = 0; k < n; ++k) V.push_back(loop.row(k));
    V.push_back(loop.colwise().mean() + Eigen::RowVector3d(0, 0, height));
    for (int k = 0; k < n; ++k) F.emplace_back(k, (k + 1) % n, n);
    return from(V, F);
}

/// Finger of `rings` rings of three vertices, `pitch` apart, closed by a tip: a thin feature that a disk map
/// squeezes by a constant factor per ring. The border is the first ring.
inline Mesh finger(int rings, double pitch) {
    std::vector<Eigen::RowVector3d> V;
    std::vector<Eigen::RowVector3i> F;
    for (int r = 0; r < rings; ++r) {
        for (int k = 0; k < 3; ++k) {
            const double angle = 2.0 * std::numbers::pi * (k + 0.5 * (r % 2)) / 3.0;
            V.emplace_back(std::cos(angle), std::sin(angle), r * pitch);
        }
    }
    V.emplace_back(0.0, 0.0, rings * pitch);
    for (int r = 0; r + 1 < rings; ++r) {
        for (int k = 0; k < 3; ++k) {
            const int a = 3 * r + k, b = 3 * r + (k + 1) % 3;
            const int shift = r % 2;  // odd rings are half a step ahead of even ones
            const int c = 3 * (r + 1) + (k + shift) % 3, d = 3 * (r + 1) + (k + shift + 2) % 3;
            F.emplace_back(a, b, c);
            F.emplace_back(a, c, d);
        }
    }
    for (int k = 0; k < 3; ++k) F.emplace_back(3 * (rings - 1) + k, 3 * (rings - 1) + (k + 1) % 3, 3 * rings);
    return from(V, F);
}

/// Vertices renumbered and triangles shuffled; new_index[old] is the new number.
struct Renumbered {
    Mesh mesh;
    std::vector<int> new_index;
};
inline Renumbered renumbered(const Mesh& mesh, unsigned seed) {
    std::mt19937_64 random(seed);
    Renumbered result{mesh, std::vector<int>(static_cast<std::size_t>(mesh.vertex_count()))};
    for (std::size_t k = 0; k < result.new_index.size(); ++k) result.new_index[k] = static_cast<int>(k);
    std::shuffle(result.new_index.begin(), result.new_index.end(), random);
    std::vector<int> order(static_cast<std::size_t>(mesh.triangle_count()));
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
    std::shuffle(order.begin(), order.end(), random);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        result.mesh.V.row(result.new_index[static_cast<std::size_t>(v)]) = mesh.V.row(v);
    }
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            result.mesh.F(f, k) = result.new_index[static_cast<std::size_t>(
                mesh.F(order[static_cast<std::size_t>(f)], (k + f) % 3))];
        }
    }
    return result;
}

/// The one border of a mesh.
inline std::vector<int> border_of(const Mesh& mesh) {
    return automorph::boundary_loops(mesh, automorph::connectivity(mesh.F, mesh.vertex_count())).at(0);
}

}  // namespace disks
