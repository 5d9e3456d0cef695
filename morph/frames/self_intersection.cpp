#include "morph/frames/self_intersection.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "morph/frames/search_tree.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

/// A volume below this share of the product of its edges' lengths is flat: slivers of one facet, whose
/// corners are rounded, do not cross.
constexpr double kFlat = 1e-9;
constexpr int kProbes = 256;           // triangles that tell how many pairs there are
constexpr double kPairsOfEach = 64.0;  // more than on any sound surface

/// Sign of the volume of a, b, c, d.
int side(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    const Vector3d u = b - a, v = c - a, w = d - a;
    const double volume = u.cross(v).dot(w), least = kFlat * u.norm() * v.norm() * w.norm();
    return (volume > least) - (volume < -least);
}

/// On which side of the triangle t the corners of u lie.
std::array<int, 3> sides(const Corners& t, const Corners& u) {
    const Vector3d v = t[1] - t[0], w = t[2] - t[0], normal = v.cross(w);
    const double least = kFlat * v.norm() * w.norm();
    std::array<int, 3> result;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3d d = u[k] - t[0];
        const double volume = normal.dot(d), flat = least * d.norm();
        result[k] = (volume > flat) - (volume < -flat);
    }
    return result;
}

/// Does the inside of segment pq, whose ends lie on two sides of the triangle, cross the inside of it?
bool crosses(const Vector3d& p, const Vector3d& q, const Corners& t) {
    const int s = side(p, q, t[0], t[1]);
    return s != 0 && s == side(p, q, t[1], t[2]) && s == side(p, q, t[2], t[0]);
}

/// Does an edge of u cross the inside of t?
bool pierces(const Corners& u, const Corners& t) {
    const std::array<int, 3> at = sides(t, u);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (at[k] * at[next] < 0 && crosses(u[k], u[next], t)) return true;
    }
    return false;
}

bool cross(const Corners& t, const Corners& u) {
    return pierces(t, u) || pierces(u, t);
}

Corners corners(const Mesh& mesh, int f) {
    return {mesh.V.row(mesh.F(f, 0)), mesh.V.row(mesh.F(f, 1)), mesh.V.row(mesh.F(f, 2))};
}

/// Do they share a vertex?
bool adjacent(const Mesh& mesh, int f, int g) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (mesh.F(f, i) == mesh.F(g, j)) return true;
        }
    }
    return false;
}

/// Boxes of some of a mesh's triangles, as a tree.
class Boxes {
public:
    Boxes(const SearchDevice& device, const Mesh& mesh, std::vector<int> triangles)
        : mesh_(mesh), triangles_(std::move(triangles)) {
        const RTCGeometry geometry = device.geometry(RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(triangles_.size()));
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryBoundsFunction(
            geometry,
            [](const RTCBoundsFunctionArguments* a) {
                static_cast<const Boxes*>(a->geometryUserPtr)->bound(a->primID, *a->bounds_o);
            },
            nullptr);
        tree_ = device.tree(geometry, RTC_SCENE_FLAG_NONE);
    }
    Boxes(const Boxes&) = delete;

    const std::vector<int>& triangles() const { return triangles_; }

    /// Calls visit(f, g) for triangles f of these boxes and g of the others where the boxes overlap, from
    /// several threads.
    template <class Visit>
    void for_overlaps(const Boxes& others, const Visit& visit) const {
        struct Pass {
            const Boxes &of, &others;
            const Visit& visit;
        } pass{*this, others, visit};
        rtcCollide(
            tree_.get(), others.tree_.get(),
            [](void* user, RTCCollision* found, unsigned count) {
                const Pass& p = *static_cast<const Pass*>(user);
                for (unsigned k = 0; k < count; ++k)
                    p.visit(p.of.triangles_[found[k].primID0], p.others.triangles_[found[k].primID1]);
            },
            &pass);
    }

private:
    void bound(unsigned primitive, RTCBounds& box) const {
        const Corners t = corners(mesh_, triangles_[primitive]);
        const Vector3d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
        // Rounded outwards to floats.
        constexpr float kBeyond = std::numeric_limits<float>::infinity();
        const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -kBeyond); };
        const auto up = [](double x) { return std::nextafter(static_cast<float>(x), kBeyond); };
        box.lower_x = down(low.x());
        box.lower_y = down(low.y());
        box.lower_z = down(low.z());
        box.upper_x = up(high.x());
        box.upper_y = up(high.y());
        box.upper_z = up(high.z());
    }

    const Mesh& mesh_;
    std::vector<int> triangles_;
    SearchTree tree_;
};

/// Of n triangles, `count` at equal steps.
std::vector<int> sample(int n, int count) {
    std::vector<int> triangles;
    for (long k = 0; k < count; ++k) triangles.push_back(static_cast<int>(k * n / count));
    return triangles;
}

/// How many of the triangles in `some` pass through others.
int crossing(const Mesh& mesh, const Boxes& some, const Boxes& all) {
    std::vector<std::atomic<char>> crosses(static_cast<std::size_t>(mesh.triangle_count()));
    some.for_overlaps(all, [&](int f, int g) {
        auto &f_crosses = crosses[static_cast<std::size_t>(f)],
             &g_crosses = crosses[static_cast<std::size_t>(g)];
        if (f == g || (f_crosses && g_crosses) || adjacent(mesh, f, g)) return;
        if (cross(corners(mesh, f), corners(mesh, g))) f_crosses = g_crosses = 1;
    });
    return static_cast<int>(std::count_if(some.triangles().begin(), some.triangles().end(),
                                          [&](int f) { return crosses[static_cast<std::size_t>(f)] != 0; }));
}

}  // namespace

SelfIntersections self_intersections(const Mesh& given, double most_pairs) {
    const int n = given.triangle_count();
    if (n == 0) return {};
    const Mesh mesh{UnitFrame(given.V).in(given.V), given.F};
    const SearchDevice device;
    const Boxes all(device, mesh, sample(n, n)), few(device, mesh, sample(n, std::min(n, kProbes)));
    std::atomic<long> overlaps = 0;
    few.for_overlaps(all, [&](int, int) { ++overlaps; });
    const double of_each = static_cast<double>(overlaps) / static_cast<double>(few.triangles().size());
    if (0.5 * of_each <= std::max(most_pairs / n, kPairsOfEach)) return {crossing(mesh, all, all), false};

    const int looked_at = static_cast<int>(std::clamp(most_pairs / of_each, 1.0, static_cast<double>(n)));
    const Boxes some(device, mesh, sample(n, looked_at));
    const double share = static_cast<double>(crossing(mesh, some, all)) / looked_at;
    return {static_cast<int>(std::lround(share * n)), true};
}

}  // namespace automorph
