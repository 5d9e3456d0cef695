#include "morph/overlay/overlay.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "exact_overlay.h"
#include "morph/mesh/errors.h"
#include "overlay_checks.h"
#include "test_maps.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

Overlay overlaid(const TestMap& a, const TestMap& b) {
    return overlay(a.mesh, a.rays, b.mesh, b.rays);
}

/// The same overlay with the roles of a and b exchanged.
Overlay exchanged(Overlay overlay) {
    std::swap(overlay.on_a, overlay.on_b);
    std::swap(overlay.vertex_of_a, overlay.vertex_of_b);
    std::swap(overlay.face_of_a, overlay.face_of_b);
    return overlay;
}

/// The overlay has all invariants and equals the rational one, either way round.
void check_pair(const TestMap& a, const TestMap& b) {
    const Overlay found = overlaid(a, b), expected = exact_overlay(a, b);
    CHECK(violations(found, a, b) == "");
    CHECK(difference(found, expected) == "");
    CHECK(difference(exchanged(overlaid(b, a)), expected) == "");
}

/// Two maps over one polygon, each with its own inner vertices and triangulation.
MapPair disk_pair(const std::vector<Ray>& border, const std::vector<Ray>& inner_a,
                  const std::vector<Ray>& inner_b, Random& random) {
    TestMap a = random_map(polygon_builder(border, random), inner_a, 20, random);
    TestMap b = random_map(polygon_builder(border, random), inner_b, 20, random);
    return {std::move(a), std::move(b)};
}

std::vector<Ray> some_of(const std::vector<Ray>& points, Random& random) {
    std::vector<Ray> chosen;
    for (const Ray& p : points)
        if (random.below(2)) chosen.push_back(p);
    return chosen;
}

/// Each coordinate of the plane moved by at most one unit in the last place.
std::vector<Ray> nudged(std::vector<Ray> points, Random& random) {
    for (Ray& p : points)
        for (int k = 0; k < 2; ++k) {
            const int step = random.below(3) - 1;
            if (step != 0) p[k] = std::nextafter(p[k], step * 1e9);
        }
    return points;
}

/// The same triangles, the points inside turned about the origin; the border stays. @pre the map stays
/// one-to-one
TestMap turned(const TestMap& map, int border, double angle) {
    std::vector<Ray> rays;
    for (int v = 0; v < map.mesh.vertex_count(); ++v) {
        Ray p = map.rays.row(v);
        if (v >= border)
            p = Ray(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                    std::sin(angle) * p.x() + std::cos(angle) * p.y(), p.z());
        rays.push_back(p);
    }
    return MapBuilder(rays, map.mesh.F).map();
}

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE("random disk maps overlay as they do in rational arithmetic") {
    Random random(1);
    for (int trial = 0; trial < 100; ++trial) {
        INFO("trial " << trial);
        const auto border = circle(3 + random.below(12), 0.1);
        const auto inner_a = random_disk_points(random.below(25), random);
        const auto inner_b = random_disk_points(random.below(25), random);
        // Points outside the polygon are left out by the builder.
        const auto [a, b] = disk_pair(border, inner_a, inner_b, random);
        check_pair(a, b);
    }
}

TEST_CASE("maps without inner vertices, chords only, overlay as they do in rational arithmetic") {
    Random random(2);
    for (int trial = 0; trial < 50; ++trial) {
        INFO("trial " << trial);
        const auto [a, b] = disk_pair(circle(3 + random.below(18)), {}, {}, random);
        check_pair(a, b);
    }
}

TEST_CASE("maps on a common lattice, with vertices, edges and crossings in common places, overlay exactly") {
    Random random(3);
    // 0.1 is no double: its lattice is collinear but for rounding.
    const double unit = GENERATE(1.0, 0.1);
    for (int trial = 0; trial < 100; ++trial) {
        INFO("unit " << unit << " trial " << trial);
        const int size = 2 + random.below(4);
        const auto inner_a = random_lattice_points(random.below(30), size, unit, random);
        const auto inner_b = random_lattice_points(random.below(30), size, unit, random);
        const auto [a, b] = disk_pair(lattice_square(size, unit), inner_a, inner_b, random);
        check_pair(a, b);
    }
}

TEST_CASE("maps whose vertices are a unit in the last place apart overlay exactly", "[sweep]") {
    Random random(4);
    for (int trial = 0; trial < 40; ++trial) {
        INFO("trial " << trial);
        const int size = 2 + random.below(4);
        const auto inner = random_lattice_points(20, size, 0.1, random);
        const auto [a, b] =
            disk_pair(lattice_square(size, 0.1), nudged(inner, random), nudged(inner, random), random);
        check_pair(a, b);
    }
}

TEST_CASE("a map over itself is itself, however it is numbered") {
    Random random(5);
    for (int trial = 0; trial < 20; ++trial) {
        INFO("trial " << trial);
        const bool disk = trial % 2 == 0;
        const TestMap a =
            disk ? random_map(polygon_builder(circle(9), random), random_disk_points(20, random), 30, random)
                 : random_map(tetrahedron_builder(random), random_directions(20, random), 30, random);
        const TestMap b = renumbered(a, random);
        const Overlay merged = overlaid(a, b);
        CHECK(violations(merged, a, b) == "");
        CHECK(merged.vertex_count() == a.mesh.vertex_count());
        CHECK(merged.coincident == a.mesh.vertex_count());
        CHECK(merged.face_count() == a.mesh.triangle_count());
        CHECK(merged.crossings == 0);
        CHECK(merged.on_edges == 0);
        check_pair(a, a);
    }
}

TEST_CASE("maps with the same vertices or some of them in common overlay exactly") {
    Random random(6);
    for (int trial = 0; trial < 40; ++trial) {
        INFO("trial " << trial);
        const auto inner = random_disk_points(25, random);
        const auto inner_b = trial % 2 == 0 ? inner : some_of(inner, random);
        const auto [a, b] = disk_pair(circle(8), inner, inner_b, random);
        const Overlay merged = overlaid(a, b);
        CHECK(merged.coincident == b.mesh.vertex_count());
        check_pair(a, b);
    }
}

TEST_CASE("random maps of the sphere overlay as they do in rational arithmetic") {
    Random random(7);
    for (int trial = 0; trial < 80; ++trial) {
        INFO("trial " << trial);
        const TestMap a =
            random_map(tetrahedron_builder(random), random_directions(random.below(25), random), 40, random);
        const TestMap b =
            random_map(tetrahedron_builder(random), random_directions(random.below(25), random), 40, random);
        check_pair(a, b);
    }
}

TEST_CASE("maps of the sphere by integer directions, with edges on common great circles, overlay exactly") {
    Random random(8);
    for (int trial = 0; trial < 100; ++trial) {
        INFO("trial " << trial);
        const int size = 1 + random.below(3);
        const auto points_a = random_integer_directions(random.below(30), size, random);
        const auto points_b = random_integer_directions(random.below(30), size, random);
        check_pair(random_map(octahedron_builder(), points_a, 40, random),
                   random_map(octahedron_builder(), points_b, 40, random));
    }
}

TEST_CASE("only the direction of a ray counts") {
    Random random(9);
    for (int trial = 0; trial < 40; ++trial) {
        INFO("trial " << trial);
        const auto inner = random_lattice_points(15, 4, 1.0, random);
        const auto [a, b] = disk_pair(lattice_square(4), inner, some_of(inner, random), random);
        check_pair(rescaled(a, random), rescaled(b, random));
    }
}

TEST_CASE("a map over itself turned by next to nothing keeps its invariants") {
    Random random(10);
    const int border = 12;
    const TestMap map = delaunay_map(polygon_builder(circle(border), random), random_disk_points(40, random));
    for (const double angle : {1e-3, 1e-6, 1e-9, 1e-12, 1e-13, 1e-14, 1e-15, 2e-16}) {
        INFO("angle " << angle);
        check_pair(map, turned(map, border, angle));
    }
}

TEST_CASE("clusters of vertices 1e-12 apart, triangles down to 1e-26, overlay exactly", "[sweep]") {
    Random random(11);
    for (int trial = 0; trial < 40; ++trial) {
        INFO("trial " << trial);
        const double size = std::pow(10.0, -6.0 - random.below(9));
        const Ray centre(0.3, 0.2, 1.0);
        const auto cluster = [&] {
            std::vector<Ray> points = random_disk_points(5, random);
            for (const Ray& p : random_disk_points(15, random))
                points.emplace_back(centre.x() + size * p.x(), centre.y() + size * p.y(), 1.0);
            return points;
        };
        const auto inner_a = cluster(), inner_b = cluster();
        const auto [a, b] = disk_pair(circle(7), inner_a, inner_b, random);
        check_pair(a, b);
    }
}

TEST_CASE("needles, triangles of height 1e-15 across the disk, overlay exactly") {
    Random random(12);
    for (int trial = 0; trial < 40; ++trial) {
        INFO("trial " << trial);
        const auto line = [&] {
            std::vector<Ray> points;
            for (int k = 0; k < 15; ++k) {
                const double x = random.uniform(-0.9, 0.9);
                points.emplace_back(x, 0.5 * x + random.uniform(-1e-15, 1e-15), 1.0);
            }
            return points;
        };
        const auto inner_a = line(), inner_b = line();
        const auto [a, b] = disk_pair(circle(8, 0.2), inner_a, inner_b, random);
        check_pair(a, b);
    }
}

TEST_CASE("maps of 50 000 triangles overlay at a cost linear in the result", "[sweep]") {
    const bool disk = GENERATE(true, false);
    INFO((disk ? "disk" : "sphere"));
    Random random(13);
    const auto map = [&](int vertices) {
        return disk ? delaunay_map(polygon_builder(circle(60), random), random_disk_points(vertices, random))
                    : delaunay_map(tetrahedron_builder(random), random_directions(vertices, random));
    };
    const auto seconds_per_vertex = [](const TestMap& a, const TestMap& b) {
        double best = 1e9;
        for (int repeat = 0; repeat < 3; ++repeat) {
            const double start = cpu_seconds();
            const int vertices = overlaid(a, b).vertex_count();
            best = std::min(best, (cpu_seconds() - start) / vertices);
        }
        return best;
    };
    const TestMap small_a = map(1300), small_b = map(1300), large_a = map(13000), large_b = map(13000);
    const Overlay merged = overlaid(large_a, large_b);
    CHECK(violations(merged, large_a, large_b) == "");
    CHECK(large_a.mesh.triangle_count() + large_b.mesh.triangle_count() > 50000);
    // A quadratic step would cost ten times as much per vertex; caches cost less than three.
    CHECK(seconds_per_vertex(large_a, large_b) < 3.0 * seconds_per_vertex(small_a, small_b));
}

TEST_CASE("maps of different domains are refused") {
    Random random(14);
    const auto inner = random_disk_points(10, random);
    const TestMap a = random_map(polygon_builder(circle(8), random), inner, 20, random);
    std::vector<Ray> border = circle(8);
    SECTION("a border vertex at another place") {
        border[3].x() = std::nextafter(border[3].x(), 9.0);
    }
    SECTION("a border vertex less") {
        border.pop_back();
    }
    SECTION("a border vertex more") {
        border.insert(border.begin() + 1, Ray(0.93, 0.39, 1.0));
    }
    SECTION("another radius") {
        for (Ray& p : border) p.head<2>() *= 2.0;
    }
    SECTION("another place") {
        for (Ray& p : border) p.x() += 10.0;
    }
    const bool same = border == circle(8);
    const TestMap b = same
                          ? random_map(tetrahedron_builder(random), random_directions(10, random), 20, random)
                          : random_map(polygon_builder(border, random), {}, 20, random);
    CHECK_THROWS_AS(overlaid(a, b), SolverFailure);
    CHECK_THROWS_AS(overlaid(b, a), SolverFailure);
}

TEST_CASE("a border vertex on a straight border edge of the other map is refused or overlaid exactly") {
    Random random(15);
    const TestMap a = random_map(polygon_builder(lattice_square(1, 4.0), random),
                                 random_lattice_points(5, 4, 1.0, random), 10, random);
    const TestMap b = random_map(polygon_builder(lattice_square(4), random),
                                 random_lattice_points(5, 4, 1.0, random), 10, random);
    try {
        check_pair(a, b);
    } catch (const SolverFailure&) {
        SUCCEED("refused");
    }
}
