#include "exact_overlay.h"

#include "overlay_checks.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

TestMap test_map(const std::vector<Ray>& rays, const std::vector<std::array<int, 3>>& triangles) {
    Triangles F(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t f = 0; f < triangles.size(); ++f)
        F.row(static_cast<Eigen::Index>(f)) << triangles[f][0], triangles[f][1], triangles[f][2];
    return MapBuilder(rays, F).map();
}

std::vector<int> corner_counts(const Overlay& overlay) {
    std::vector<int> counts(7, 0);
    for (int f = 0; f < overlay.face_count(); ++f)
        ++counts.at(static_cast<std::size_t>(overlay.polygon_start[f + 1] - overlay.polygon_start[f]));
    return counts;
}

const std::vector<Ray> kSquare = {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

}  // namespace

TEST_CASE("two diagonals of a square cross once") {
    const TestMap a = test_map(kSquare, {{0, 1, 2}, {0, 2, 3}}),
                  b = test_map(kSquare, {{0, 1, 3}, {1, 2, 3}});
    const Overlay overlay = exact_overlay(a, b);
    CHECK(violations(overlay, a, b) == "");
    CHECK(overlay.vertex_count() == 5);
    CHECK(overlay.face_count() == 4);
    CHECK(overlay.crossings == 1);
    CHECK(overlay.coincident == 4);
    CHECK(overlay.on_edges == 0);
    const Site& crossing = overlay.on_a[4].count == 2 ? overlay.on_a[4] : overlay.on_a[2];
    CHECK(crossing.weights[0] == 0.5);
}

TEST_CASE("a map over itself is itself") {
    const TestMap a = test_map(kSquare, {{0, 1, 2}, {0, 2, 3}});
    const Overlay overlay = exact_overlay(a, a);
    CHECK(violations(overlay, a, a) == "");
    CHECK(overlay.vertex_count() == 4);
    CHECK(overlay.face_count() == 2);
    CHECK(overlay.coincident == 4);
}

TEST_CASE("a vertex on the other map's diagonal splits it") {
    std::vector<Ray> with_centre = kSquare;
    with_centre.emplace_back(0.25, 0.25, 1);
    const TestMap a = test_map(kSquare, {{0, 1, 2}, {0, 2, 3}});
    const TestMap b = test_map(with_centre, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const Overlay overlay = exact_overlay(a, b);
    CHECK(violations(overlay, a, b) == "");
    CHECK(overlay.vertex_count() == 5);
    CHECK(overlay.face_count() == 4);
    CHECK(overlay.crossings == 0);
    CHECK(overlay.on_edges == 1);
    const int centre = overlay.vertex_of_b[4];
    REQUIRE(overlay.on_a[centre].count == 2);
    CHECK(overlay.on_a[centre].corners[0] == 0);
    CHECK(overlay.on_a[centre].weights[0] == 0.75);
}

TEST_CASE("two inner triangles upside down overlap in a hexagon") {
    const std::vector<Ray> square = {{-9, -9, 1}, {9, -9, 1}, {9, 9, 1}, {-9, 9, 1}};
    std::vector<Ray> up = square, down = square;
    for (const auto& [x, y] : {std::pair{-3.0, -2.0}, {3.0, -2.0}, {0.0, 4.0}}) {
        up.emplace_back(x, y, 1);
        down.emplace_back(-x, -y, 1);
    }
    const TestMap a = test_map(
        up, {{4, 5, 6}, {0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 4, 6}, {3, 0, 4}});
    const TestMap b = test_map(
        down, {{4, 5, 6}, {2, 3, 4}, {3, 5, 4}, {3, 0, 5}, {0, 6, 5}, {0, 1, 6}, {1, 4, 6}, {1, 2, 4}});
    const Overlay overlay = exact_overlay(a, b);
    CHECK(violations(overlay, a, b) == "");
    CHECK(corner_counts(overlay)[6] >= 1);
    CHECK(overlay.coincident == 4);
    CHECK(overlay.vertex_count() == 7 + 7 - 4 + overlay.crossings);
}

TEST_CASE("two octahedra an eighth of a turn apart share their poles and their equator") {
    const TestMap a = octahedron_builder().map();
    TestMap b = a;
    for (int v = 0; v < 4; ++v)
        b.rays.row(v) = Ray(a.rays(v, 0) - a.rays(v, 1), a.rays(v, 0) + a.rays(v, 1), 0);
    const Overlay overlay = exact_overlay(a, b);
    CHECK(violations(overlay, a, b) == "");
    CHECK(overlay.vertex_count() == 10);
    CHECK(overlay.face_count() == 16);
    CHECK(overlay.crossings == 0);
    CHECK(overlay.coincident == 2);
    CHECK(overlay.on_edges == 8);
}

TEST_CASE("a cube over an octahedron meets it in the cube's diagonals and edge midpoints") {
    const TestMap octahedron = octahedron_builder().map();
    const TestMap cube = test_map(
        {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
        {{0, 2, 1},
         {0, 3, 2},
         {4, 5, 6},
         {4, 6, 7},
         {0, 1, 5},
         {0, 5, 4},
         {1, 2, 6},
         {1, 6, 5},
         {2, 3, 7},
         {2, 7, 6},
         {3, 0, 4},
         {3, 4, 7}});
    const Overlay overlay = exact_overlay(cube, octahedron);
    CHECK(violations(overlay, cube, octahedron) == "");
    CHECK(overlay.vertex_count() == 26);
    CHECK(overlay.face_count() == 36);
    CHECK(overlay.crossings == 12);
    CHECK(overlay.coincident == 0);
    CHECK(overlay.on_edges == 6);
}

TEST_CASE("damage to an overlay is noticed") {
    const TestMap a = test_map(kSquare, {{0, 1, 2}, {0, 2, 3}}),
                  b = test_map(kSquare, {{0, 1, 3}, {1, 2, 3}});
    const Overlay good = exact_overlay(a, b);
    Overlay bad = good;
    SECTION("a face turned round") {
        std::swap(bad.polygon_vertices[0], bad.polygon_vertices[1]);
    }
    SECTION("a face dropped") {
        bad.face_of_a.pop_back();
        bad.face_of_b.pop_back();
        bad.polygon_start.pop_back();
        bad.polygon_vertices.resize(static_cast<std::size_t>(bad.polygon_start.back()));
    }
    SECTION("a face in the wrong triangle") {
        bad.face_of_a[0] = 1 - bad.face_of_a[0];
    }
    SECTION("a weight off by rounding of single precision") {
        for (Site& site : bad.on_a)
            if (site.count == 2) site.weights[0] += 1e-8, site.weights[1] -= 1e-8;
    }
    SECTION("a count") {
        ++bad.crossings;
    }
    SECTION("a lost input vertex") {
        bad.vertex_of_b[2] = bad.vertex_of_b[1];
    }
    CHECK(violations(bad, a, b) != "");
}

TEST_CASE("a different overlay of the same maps is told apart") {
    const TestMap a = test_map(kSquare, {{0, 1, 2}, {0, 2, 3}}),
                  b = test_map(kSquare, {{0, 1, 3}, {1, 2, 3}});
    const Overlay expected = exact_overlay(a, b);
    CHECK(difference(expected, expected) == "");
    Overlay bad = expected;
    SECTION("corners turned round") {
        std::swap(bad.polygon_vertices[0], bad.polygon_vertices[1]);
    }
    SECTION("another pair of triangles") {
        std::swap(bad.face_of_a.front(), bad.face_of_a.back());
    }
    SECTION("a vertex too many") {
        bad.on_a.push_back(bad.on_a[0]);
        bad.on_b.push_back(bad.on_b[0]);
    }
    SECTION("a weight") {
        for (Site& site : bad.on_a)
            if (site.count == 2) site.weights[0] *= 1 + 1e-10;
    }
    CHECK(difference(bad, expected) != "");
}
