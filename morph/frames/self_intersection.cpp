#include "morph/frames/self_intersection.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

#include "morph/mesh/errors.h"

namespace automorph {

namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

/// A volume below this share of the product of its edges' lengths is flat: slivers of one facet, whose
/// corners are rounded, do not cross.
constexpr double kFlat = 1e-9;

/// Sign of the volume of a, b, c, d.
int side(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) {
    const Vector3d u = b - a, v = c - a, w = d - a;
    const double volume = u.cross(v).dot(w), least = kFlat * u.norm() * v.norm() * w.norm();
    return (volume > least) - (volume < -least);
}

/// Does the inside of segment pq cross the inside of the triangle?
bool crosses(const Vector3d& p, const Vector3d& q, const Corners& t) {
    if (side(t[0], t[1], t[2], p) * side(t[0], t[1], t[2], q) >= 0) return false;
    const int s = side(p, q, t[0], t[1]);
    return s != 0 && s == side(p, q, t[1], t[2]) && s == side(p, q, t[2], t[0]);
}

bool cross(const Corners& t, const Corners& u) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (crosses(t[k], t[(k + 1) % 3], u) || crosses(u[k], u[(k + 1) % 3], t)) return true;
    }
    return false;
}

struct Search {
    const Mesh& mesh;
    std::vector<std::atomic<char>> crossing;

    Corners corners(int f) const {
        return {mesh.V.row(mesh.F(f, 0)), mesh.V.row(mesh.F(f, 1)), mesh.V.row(mesh.F(f, 2))};
    }
    bool adjacent(int f, int g) const {
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                if (mesh.F(f, i) == mesh.F(g, j)) return true;
            }
        }
        return false;
    }
};

void bound(const RTCBoundsFunctionArguments* arguments) {
    const auto& search = *static_cast<const Search*>(arguments->geometryUserPtr);
    const Corners t = search.corners(static_cast<int>(arguments->primID));
    const Vector3d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    // Rounded outwards to floats.
    constexpr float kBeyond = std::numeric_limits<float>::infinity();
    const auto down = [](double x) { return std::nextafter(static_cast<float>(x), -kBeyond); };
    const auto up = [](double x) { return std::nextafter(static_cast<float>(x), kBeyond); };
    RTCBounds& box = *arguments->bounds_o;
    box.lower_x = down(low.x());
    box.lower_y = down(low.y());
    box.lower_z = down(low.z());
    box.upper_x = up(high.x());
    box.upper_y = up(high.y());
    box.upper_z = up(high.z());
}

void collide(void* user, RTCCollision* collisions, unsigned count) {
    Search& search = *static_cast<Search*>(user);
    for (unsigned k = 0; k < count; ++k) {
        const int f = static_cast<int>(collisions[k].primID0), g = static_cast<int>(collisions[k].primID1);
        if (f == g || search.adjacent(f, g)) continue;
        auto &of_f = search.crossing[static_cast<std::size_t>(f)],
             &of_g = search.crossing[static_cast<std::size_t>(g)];
        if ((of_f && of_g) || !cross(search.corners(f), search.corners(g))) continue;
        of_f = of_g = 1;
    }
}

}  // namespace

std::vector<char> self_intersecting(const Mesh& mesh) {
    const auto n = static_cast<std::size_t>(mesh.triangle_count());
    Search search{mesh, std::vector<std::atomic<char>>(n)};
    const RTCDevice device = rtcNewDevice("threads=1");
    if (!device) throw SolverFailure("self-intersections: Embree could not be started");
    const RTCScene scene = rtcNewScene(device);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(n));
    rtcSetGeometryUserData(geometry, &search);
    rtcSetGeometryBoundsFunction(
        geometry, [](const RTCBoundsFunctionArguments* a) { bound(a); }, nullptr);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    const bool built = rtcGetDeviceError(device) == RTC_ERROR_NONE;
    if (built) rtcCollide(scene, scene, collide, &search);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    if (!built) throw SolverFailure("self-intersections: Embree could not build its tree");
    return {search.crossing.begin(), search.crossing.end()};
}

}  // namespace automorph
