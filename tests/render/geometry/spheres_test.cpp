#include "render/geometry/spheres.h"

#include <cmath>

#include "morph/mesh/geometry.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::render;

namespace {

/// The share of the unit ball's volume that its mesh lacks.
double sphere_defect(int steps) {
    constexpr double kBall = 4.0 / 3.0 * 3.14159265358979;
    const Sphere sphere = make_sphere(steps);
    return 1.0 - signed_volume({sphere.directions, sphere.triangles}) / kBall;
}

}  // namespace

TEST_CASE("a marker is a sphere that faces outwards") {
    const Sphere sphere = make_sphere(8);
    CHECK((sphere.directions.rowwise().norm().array() - 1.0).abs().maxCoeff() < 1e-12);
    CHECK(sphere.triangles.rows() == 8 * 64);
    CHECK(sphere.triangles.minCoeff() == 0);
    CHECK(sphere.triangles.maxCoeff() == sphere.directions.rows() - 1);
    const Mesh mesh{sphere.directions, sphere.triangles};
    CHECK(sphere_defect(8) > 0.0);  // inscribed
    CHECK(sphere_defect(16) == Approx(sphere_defect(8) / 4).epsilon(0.02));
    CHECK(sphere_defect(32) == Approx(sphere_defect(8) / 16).epsilon(0.03));
    CHECK(triangle_areas(mesh).minCoeff() > 0.1 * triangle_areas(mesh).mean());
}

TEST_CASE("spheres lie about their points") {
    const Sphere sphere = make_sphere(4);
    Points centers(3, 3);
    centers << 1, 2, 3, -5, 0, 0, 0, 0, 7;
    const Points V = sphere_vertices(sphere, centers, 0.25);
    const Triangles F = sphere_triangles(sphere, 3);
    const Eigen::Index n = sphere.directions.rows(), m = sphere.triangles.rows();
    REQUIRE(V.rows() == 3 * n);
    REQUIRE(F.rows() == 3 * m);
    for (Eigen::Index i = 0; i < 3; ++i) {
        CHECK(((V.middleRows(n * i, n).rowwise() - centers.row(i)).rowwise().norm().array() - 0.25)
                  .abs()
                  .maxCoeff() < 1e-12);
        CHECK(F.middleRows(m * i, m).minCoeff() == n * i);
        CHECK(F.middleRows(m * i, m).maxCoeff() == n * (i + 1) - 1);
    }
}
