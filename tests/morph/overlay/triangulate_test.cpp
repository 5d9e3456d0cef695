#include "morph/overlay/triangulate.h"

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "tests/catch.h"

using namespace automorph;

namespace {

Mesh big_triangle() {
    Mesh mesh;
    mesh.V.resize(3, 3);
    mesh.V << -9, -9, 0, 9, -9, 0, 0, 18, 0;
    mesh.F.resize(1, 3);
    mesh.F << 0, 1, 2;
    return mesh;
}

/// One merged face with the given corners.
Overlay one_face(int corners) {
    Overlay overlay;
    overlay.polygon_start = {0, corners};
    for (int i = 0; i < corners; ++i) overlay.polygon_vertices.push_back(i);
    overlay.face_of_a = overlay.face_of_b = {0};
    return overlay;
}

double area_sum(const Points& V, const Triangles& F) {
    double sum = 0;
    for (int f = 0; f < F.rows(); ++f) {
        const Eigen::Vector3d p = V.row(F(f, 0)), q = V.row(F(f, 1)), r = V.row(F(f, 2));
        const double signed_area = 0.5 * (q - p).cross(r - p).z();
        CHECK(signed_area > 0);
        sum += signed_area;
    }
    return sum;
}

Points regular(int corners) {
    Points V(corners, 3);
    for (int i = 0; i < corners; ++i)
        V.row(i) << std::cos(2 * M_PI * i / corners), std::sin(2 * M_PI * i / corners), 0;
    return V;
}

bool has_diagonal(const Triangles& F, int i, int j) {
    int found = 0;
    for (int f = 0; f < F.rows(); ++f) {
        std::set<int> corners{F(f, 0), F(f, 1), F(f, 2)};
        found += corners.count(i) && corners.count(j);
    }
    return found == 2;
}

}  // namespace

TEST_CASE("a face of n corners gives n - 2 triangles that keep its orientation and area") {
    const Mesh shape = big_triangle();
    for (int n = 3; n <= 6; ++n) {
        const Points V = regular(n);
        const MergedTriangles merged = triangulate(one_face(n), shape, V, shape, V);
        REQUIRE(merged.F.rows() == n - 2);
        REQUIRE(merged.face == std::vector<int>(static_cast<std::size_t>(n - 2), 0));
        CHECK(area_sum(V, merged.F) == Approx(0.5 * n * std::sin(2 * M_PI / n)));
    }
}

TEST_CASE("a quad takes the diagonal that is good on both shapes") {
    const Mesh shape = big_triangle();
    Points square(4, 3), flat(4, 3);
    square << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
    flat << 0, -0.05, 0, 1, 0, 0, 0, 0.05, 0, -1, 0,
        0;  // only the diagonal 0-2 gives triangles with area to speak of
    CHECK(has_diagonal(triangulate(one_face(4), shape, square, shape, flat).F, 0, 2));
    CHECK(has_diagonal(triangulate(one_face(4), shape, flat, shape, square).F, 0, 2));
}

TEST_CASE("a diagonal outside a lifted, no longer convex face is not taken") {
    const Mesh shape = big_triangle();
    Points square(4, 3), dart(4, 3);
    square << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
    dart << 0, 0, 0, 1, -1, 0, 0.5, 0, 0, 1, 1, 0;  // corner 2 is reflex
    CHECK(has_diagonal(triangulate(one_face(4), shape, square, shape, dart).F, 0, 2));
}

TEST_CASE("corners at one place do not break the triangulation") {
    const Mesh shape = big_triangle();
    Points V = regular(5);
    V.row(1) = V.row(0);
    CHECK(triangulate(one_face(5), shape, V, shape, V).F.rows() == 3);
}
