#include "morph/overlay/snap.h"

#include <cmath>
#include <ctime>
#include <numeric>

#include "morph/exact/predicates.h"
#include "morph/overlay/overlay.h"
#include "test_maps.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

constexpr int kBorder = 12;

/// A Delaunay map of the disk; its first kBorder vertices are the border. Inner points are shrunk towards the
/// origin.
TestMap disk(int inner, double scale, std::uint64_t seed) {
    Random random(seed);
    std::vector<Ray> points = random_disk_points(inner, random);
    for (Ray& p : points) p.head<2>() *= 0.9 * scale;
    return delaunay_map(polygon_builder(circle(kBorder), random), points);
}

std::vector<int> border() {
    std::vector<int> loop(kBorder);
    std::iota(loop.begin(), loop.end(), 0);
    return loop;
}

Points turned(const Points& rays, double angle) {
    Points result = rays;
    for (int v = kBorder; v < rays.rows(); ++v)
        result.row(v) << std::cos(angle) * rays(v, 0) - std::sin(angle) * rays(v, 1),
            std::sin(angle) * rays(v, 0) + std::cos(angle) * rays(v, 1), 1.0;
    return result;
}

bool one_to_one(const Triangles& F, const Points& rays) {
    for (int f = 0; f < F.rows(); ++f)
        if (orientation(rays.row(F(f, 0)), rays.row(F(f, 1)), rays.row(F(f, 2))) <= 0) return false;
    return true;
}

double snap_seconds(int inner, double scale) {
    const TestMap a = disk(inner, scale, 5), b = disk(inner, scale, 6);
    Points rays = b.rays;
    const std::clock_t start = std::clock();
    snap_vertices(b.mesh, border(), rays, a.rays);
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE("a map over itself turned by less than the tolerance snaps back onto itself") {
    const TestMap map = disk(300, 1.0, 1);
    for (const double angle : {0.0, 1e-13, 1e-9, 1e-8}) {
        INFO("angle " << angle);
        Points rays = turned(map.rays, angle);
        const int moved = snap_vertices(map.mesh, border(), rays, map.rays);
        CHECK(rays == map.rays);
        if (angle >= 1e-9) CHECK(moved > 290);
        if (angle == 0.0) CHECK(moved == 0);
        const Overlay merged = overlay(map.mesh, map.rays, map.mesh, rays);
        CHECK(merged.vertex_count() == map.mesh.vertex_count());
        CHECK(merged.crossings == 0);
    }
}

TEST_CASE("vertices further away than the tolerance stay") {
    const TestMap map = disk(300, 1.0, 2);
    const Points rays = turned(map.rays, 1e-3);
    Points snapped = rays;
    CHECK(snap_vertices(map.mesh, border(), snapped, map.rays) == 0);
    CHECK(snapped == rays);
}

TEST_CASE("snapping keeps a map one-to-one and moves no vertex further than the tolerance") {
    // Maps whose vertices are about as far apart as the tolerance.
    for (const double scale : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
        INFO("scale " << scale);
        const TestMap a = disk(400, scale, 3), b = disk(400, scale, 4);
        Points rays = b.rays;
        snap_vertices(b.mesh, border(), rays, a.rays);
        CHECK(one_to_one(b.mesh.F, rays));
        CHECK((rays - b.rays).rowwise().norm().maxCoeff() <= kSnap);
        CHECK(rays.topRows(kBorder) == b.rays.topRows(kBorder));
        for (int v = 0; v < rays.rows(); ++v)
            for (int w = 0; w < v; ++w) REQUIRE(rays.row(v) != rays.row(w));
    }
}

TEST_CASE("snapping costs no more where a map squeezes thousands of vertices into the tolerance") {
    // Harmonic maps do that to limbs.
    CHECK(snap_seconds(8000, 0.2 * kSnap) < 20 * snap_seconds(8000, 1.0));
}
