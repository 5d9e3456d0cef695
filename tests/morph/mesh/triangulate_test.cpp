#include "morph/mesh/triangulate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "morph/mesh/geometry.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

/// A polygon in the plane: its area by the shoelace formula against the signed areas of its triangles. Only
/// triangles that all turn the same way and add up to the polygon's area cover it exactly once.
void check_covers(const std::vector<std::array<double, 3>>& corners) {
    std::vector<int> polygon(corners.size());
    for (std::size_t i = 0; i < polygon.size(); ++i) polygon[i] = static_cast<int>(i);
    const PolygonSoup s = soup(corners, {polygon});
    const TriangulatedSoup result = triangulate(s);
    REQUIRE(result.F.rows() == static_cast<Eigen::Index>(corners.size()) - 2);
    Eigen::Vector3d whole = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < s.V.rows(); ++i) {
        const Eigen::Vector3d p = s.V.row(i), q = s.V.row((i + 1) % s.V.rows());
        whole += 0.5 * p.cross(q);
    }
    double sum = 0.0, smallest = 1e300;
    for (const auto& f : result.F.rowwise()) {
        const Eigen::Vector3d a = s.V.row(f[0]), b = s.V.row(f[1]), c = s.V.row(f[2]);
        const double area = 0.5 * (b - a).cross(c - a).dot(whole.normalized());
        smallest = std::min(smallest, area);
        sum += area;
    }
    CHECK(smallest > 0.0);
    CHECK(sum == Approx(whole.norm()).epsilon(1e-12));
}

}  // namespace

TEST_CASE("concave polygons are covered exactly once") {
    SECTION("an L") {
        check_covers({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
    }
    SECTION("an arrow, its notch at each corner in turn") {
        std::vector<std::array<double, 3>> arrow = {{0, 0, 1}, {2, 1, 1}, {0, 2, 1}, {0.9, 1, 1}};
        for (int turn = 0; turn < 4; ++turn) {
            std::rotate(arrow.begin(), arrow.begin() + 1, arrow.end());
            check_covers(arrow);
        }
    }
    SECTION("a comb") {
        std::vector<std::array<double, 3>> comb;
        for (int i = 0; i < 20; ++i) {
            comb.push_back({i * 1.0, 0.1 * (i % 2), 0});
            comb.push_back({i + 0.5, 5, 0});
        }
        comb.push_back({20, -1, 0});
        comb.push_back({-1, -1, 0});
        std::reverse(comb.begin(), comb.end());
        check_covers(comb);
    }
    SECTION("a spiral, tilted") {
        std::vector<std::array<double, 3>> spiral;
        for (int i = 0; i <= 60; ++i) {
            const double a = 0.2 * i, r = 1 + 0.3 * i;
            spiral.push_back({r * std::cos(a), r * std::sin(a), r * std::cos(a)});
        }
        for (int i = 60; i >= 0; --i) {
            const double a = 0.2 * i, r = 0.6 + 0.3 * i;
            spiral.push_back({r * std::cos(a), r * std::sin(a), r * std::cos(a)});
        }
        check_covers(spiral);
    }
    SECTION("a triangle with points on its sides") {
        check_covers({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 1.5, 0}, {0, 3, 0}, {0, 1, 0}});
    }
    SECTION("random star-shaped polygons") {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> radius(0.1, 1.0);
        for (int n = 5; n < 60; ++n) {
            std::vector<std::array<double, 3>> star;
            for (int i = 0; i < n; ++i) {
                const double a = 2 * M_PI * i / n, r = radius(random);
                star.push_back({r * std::cos(a), r * std::sin(a), 0.2 * r * std::sin(a)});
            }
            check_covers(star);
        }
    }
}

TEST_CASE("a polygon with a hole reached through a bridge is covered exactly once") {
    const PolygonSoup s =
        soup({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}},
             {{0, 1, 2, 3, 0, 4, 5, 6, 7, 4}});
    const TriangulatedSoup result = triangulate(s);
    CHECK(result.F.rows() == 8);
    CHECK(triangle_areas({s.V, result.F}).sum() == Approx(12.0));
}

TEST_CASE("of two diagonals the one with the better triangles is taken") {
    const PolygonSoup s = soup({{0, 0, 0}, {1, -0.2, 0}, {2, 0, 0}, {1, 0.2, 0}}, {{0, 1, 2, 3}});
    const Triangles F = triangulate(s).F;
    for (const auto& f : F.rowwise()) {
        int ends = 0;
        for (int k = 0; k < 3; ++k) ends += f[k] == 1 || f[k] == 3 ? 1 : 0;
        CHECK(ends == 2);
    }
}

TEST_CASE("a diagonal that is an edge elsewhere is avoided, as it would have three triangles") {
    // The better diagonal of the kite, 1-3, is already a side of both triangles.
    const PolygonSoup s = soup({{0, 0, 0}, {1, -0.2, 0}, {2, 0, 0}, {1, 0.2, 0}, {1, 0, 1}, {1, 0, -1}},
                               {{0, 1, 2, 3}, {1, 3, 4}, {3, 1, 5}});
    int diagonal = 0;
    const Triangles F = triangulate(s).F.topRows(2);
    for (const auto& f : F.rowwise()) {
        for (int k = 0; k < 3; ++k) diagonal += f[k] == 1 || f[k] == 3 ? 1 : 0;
    }
    CHECK(diagonal == 2);
}

TEST_CASE("repeated corners and polygons of one or two corners are counted, not split") {
    const PolygonSoup s = soup({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                               {{0, 1, 1, 2}, {0, 0, 1}, {2, 3}, {1}, {}, {0, 2, 3, 0}, {0, 1, 0, 1}});
    const TriangulatedSoup result = triangulate(s);
    CHECK(result.F.rows() == 2);
    CHECK(result.F.row(0) == Eigen::RowVector3i(0, 1, 2));
    CHECK(result.polygon == std::vector<int>{0, 5});
    CHECK(result.too_small == 3);
    CHECK(result.degenerate == 3);
}

TEST_CASE("the corners of a polygon without area are still joined into n - 2 triangles") {
    const TriangulatedSoup result =
        triangulate(soup({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}, {{0, 1, 2, 3, 4}}));
    CHECK(result.F.rows() == 3);
    CHECK(result.F.minCoeff() == 0);
    CHECK(result.F.maxCoeff() == 4);
}
