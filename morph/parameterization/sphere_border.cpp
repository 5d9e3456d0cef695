#include "morph/parameterization/sphere_border.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "morph/mesh/geometry.h"
#include "morph/mesh/index.h"

namespace automorph {

namespace {

constexpr double kLeastCap = 0.002, kLargestCap = 0.5;

std::uint64_t edge_key(int u, int v) {
    return (static_cast<std::uint64_t>(std::min(u, v)) << 32) | static_cast<std::uint32_t>(std::max(u, v));
}

}  // namespace

double cap_share(const Mesh& mesh, const std::vector<int>& loop) {
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    for (const int v : loop) mean += mesh.V.row(v) / static_cast<double>(loop.size());
    double cap = 0.0;
    for (std::size_t k = 0; k < loop.size(); ++k) {
        const Eigen::RowVector3d from = mesh.V.row(loop[k]) - mean,
                                 to = mesh.V.row(loop[(k + 1) % loop.size()]) - mean;
        cap += 0.5 * from.cross(to).norm();
    }
    const double whole = cap + triangle_areas(mesh).sum();
    return whole > 0.0 ? cap / whole : 0.0;
}

double locked_height(double share_a, double share_b) {
    return -(1.0 - 2.0 * std::clamp(0.5 * (share_a + share_b), kLeastCap, kLargestCap));
}

Points locked_border(const Eigen::VectorXd& angles, double z) {
    const double radius = std::sqrt((1.0 - z) * (1.0 + z));
    Points rays(angles.size(), 3);
    for (Eigen::Index k = 0; k < angles.size(); ++k) {
        rays.row(k) << radius * std::cos(angles[k]), radius * std::sin(angles[k]), z;
    }
    return rays;
}

ChordFreeMesh split_chords(const Mesh& mesh, const std::vector<int>& loop) {
    std::vector<int> next(at(mesh.vertex_count()), -1);  // along the border
    for (std::size_t k = 0; k < loop.size(); ++k) next[at(loop[k])] = loop[(k + 1) % loop.size()];
    const auto is_chord = [&](int u, int v) {
        return next[at(u)] >= 0 && next[at(v)] >= 0 && next[at(u)] != v && next[at(v)] != u;
    };
    ChordFreeMesh result{mesh, {}};
    std::unordered_map<std::uint64_t, int> middle;
    std::vector<Eigen::RowVector3i> added;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        std::array<int, 3> m{-1, -1, -1};  // midpoint of the edge from corner k on
        int chords = 0;
        for (int k = 0; k < 3; ++k) {
            const int u = mesh.F(f, k), v = mesh.F(f, (k + 1) % 3);
            if (!is_chord(u, v)) continue;
            ++chords;
            const int vertex = mesh.vertex_count() + static_cast<int>(result.midpoint.size());
            const auto [found, is_new] = middle.try_emplace(edge_key(u, v), vertex);
            if (is_new) result.midpoint.push_back({u, v});
            m[at(k)] = found->second;
        }
        if (chords == 0) continue;
        // Corner a such that ab is a chord, and ca is not unless all are.
        int k = 0;
        while (m[at(k)] < 0 || (chords == 2 && m[at((k + 2) % 3)] >= 0)) ++k;
        const int a = mesh.F(f, k), b = mesh.F(f, (k + 1) % 3), c = mesh.F(f, (k + 2) % 3);
        const int ab = m[at(k)], bc = m[at((k + 1) % 3)], ca = m[at((k + 2) % 3)];
        const int before_a = ca >= 0 ? ca : c;
        result.mesh.F.row(f) << a, ab, before_a;
        if (bc < 0) {
            added.emplace_back(ab, b, c);
        } else {
            added.emplace_back(ab, b, bc);
            added.emplace_back(ab, bc, before_a);
            if (ca >= 0) added.emplace_back(ca, bc, c);
        }
    }
    result.mesh.V.conservativeResize(mesh.vertex_count() + static_cast<Eigen::Index>(result.midpoint.size()),
                                     3);
    for (std::size_t k = 0; k < result.midpoint.size(); ++k) {
        result.mesh.V.row(mesh.vertex_count() + static_cast<Eigen::Index>(k)) =
            0.5 * (mesh.V.row(result.midpoint[k][0]) + mesh.V.row(result.midpoint[k][1]));
    }
    result.mesh.F.conservativeResize(mesh.triangle_count() + static_cast<Eigen::Index>(added.size()), 3);
    for (std::size_t k = 0; k < added.size(); ++k) {
        result.mesh.F.row(mesh.triangle_count() + static_cast<Eigen::Index>(k)) = added[k];
    }
    return result;
}

ClosedMesh closed_with_apex(const Mesh& mesh, const std::vector<int>& loop) {
    ClosedMesh closed{mesh, {}, mesh.triangle_count()};
    if (loop.empty()) return closed;
    const int apex = mesh.vertex_count();
    const auto n = static_cast<Eigen::Index>(loop.size());
    closed.fixed.assign(at(apex) + 1, 0);
    closed.fixed[at(apex)] = 1;
    closed.mesh.V.conservativeResize(apex + 1, 3);
    closed.mesh.V.row(apex) = mesh.V.row(loop[0]);  // its place is never looked at
    closed.mesh.F.conservativeResize(closed.surface + n, 3);
    for (std::size_t k = 0; k < loop.size(); ++k) {
        closed.mesh.F.row(closed.surface + static_cast<Eigen::Index>(k)) << loop[(k + 1) % loop.size()],
            loop[k], apex;
        closed.fixed[at(loop[k])] = 1;
    }
    return closed;
}

}  // namespace automorph
