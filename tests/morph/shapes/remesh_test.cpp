#include "morph/shapes/remesh.h"

#include <cmath>
#include <numbers>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/radial.h"
#include "tests/catch.h"
#include "tests/morph/shapes/triangle_quality.h"

using namespace automorph;

namespace {

using std::numbers::pi;

FieldSample unit_sphere(const Eigen::Vector3d& p) {
    return {p.squaredNorm() - 1.0, 2.0 * p};
}

/// Radii 1 and 0.35 about the z axis.
FieldSample torus(const Eigen::Vector3d& p) {
    const double ring = std::hypot(p.x(), p.y());
    const Eigen::Vector3d from_ring(p.x() - p.x() / ring, p.y() - p.y() / ring, p.z());
    return {from_ring.norm() - 0.35, from_ring.normalized()};
}

Mesh torus_grid(int around, int across) {
    Mesh mesh;
    mesh.V.resize(around * across, 3);
    mesh.F.resize(2 * around * across, 3);
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2 * pi * i / around, v = 2 * pi * j / across, r = 1 + 0.35 * std::cos(v);
            mesh.V.row(i * across + j) << r * std::cos(u), r * std::sin(u), 0.35 * std::sin(v);
            const int i1 = (i + 1) % around, j1 = (j + 1) % across;
            mesh.F.row(2 * (i * across + j)) << i * across + j, i1 * across + j, i1 * across + j1;
            mesh.F.row(2 * (i * across + j) + 1) << i * across + j, i1 * across + j1, i * across + j1;
        }
    }
    return mesh;
}

}  // namespace

TEST_CASE("Remeshing keeps the genus and makes even triangles of any mesh near the surface") {
    for (const int triangles : {1500, 6000}) {
        CAPTURE(triangles);
        RemeshOptions options;
        options.triangles = triangles;
        const Mesh mesh = remesh(torus_grid(60, 12), torus, options);  // 1440 triangles, up to 1 : 3.5
        CHECK(mesh.triangle_count() == triangles);
        const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
        CHECK(euler_characteristic(topology) == 0);
        // Chords of the small circle: a share of about h^2 / (4 r^2) of the volume is missing.
        const double area = 4 * pi * pi * 0.35, volume = 2 * pi * pi * 0.35 * 0.35;
        const double chords = area * 4.0 / std::sqrt(3.0) / triangles / (4 * 0.35 * 0.35);
        CHECK(triangle_areas(mesh).sum() == Approx(area).epsilon(chords));
        CHECK(signed_volume(mesh) == Approx(volume).epsilon(chords));
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            CHECK(std::abs(torus(mesh.V.row(v).transpose()).value) < 1e-14);
        }
        const TriangleQuality quality = triangle_quality(mesh);
        CHECK(quality.least_angle > 26.0);
        CHECK(quality.mean_least_angle > 49.0);
    }
}

TEST_CASE("The result owes nothing to the pattern of the mesh it starts from") {
    // An icosphere of exactly the wanted size is a fixed point of splits, collapses and relaxation.
    const Mesh start = radial_mesh(unit_sphere, 2.0, 1);
    RemeshOptions options;
    options.triangles = start.triangle_count();
    const Mesh mesh = remesh(start, unit_sphere, options);
    REQUIRE(mesh.vertex_count() == start.vertex_count());
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    int regular = 0;
    for (const auto v : topology.vertices()) regular += topology.valence(v) == 6;
    CHECK(regular < 0.8 * mesh.vertex_count());
    CHECK(triangle_quality(mesh).least_angle > 25.0);
}

TEST_CASE("Edges follow the spacing asked for, and triangles stay even") {
    RemeshOptions options;
    options.triangles = 6000;
    options.spacing = [](const Eigen::Vector3d& p) { return 0.65 - 0.35 * p.z(); };  // 0.3 above to 1 below
    const Mesh mesh = remesh(radial_mesh(unit_sphere, 2.0, 1), unit_sphere, options);
    CHECK(mesh.triangle_count() == 6000);
    CHECK(triangle_quality(mesh).least_angle > 22.0);
    // Every triangle's area is the same share of the spacing squared.
    const Eigen::VectorXd areas = triangle_areas(mesh);
    double above = 0.0, below = 0.0;
    int count_above = 0, count_below = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const Eigen::Vector3d centre =
            (mesh.V.row(mesh.F(f, 0)) + mesh.V.row(mesh.F(f, 1)) + mesh.V.row(mesh.F(f, 2))).transpose() /
            3.0;
        const double relative = areas[f] / std::pow(options.spacing(centre), 2);
        (centre.z() > 0.8 ? above : below) += centre.z() > 0.8 || centre.z() < -0.8 ? relative : 0.0;
        count_above += centre.z() > 0.8;
        count_below += centre.z() < -0.8;
    }
    CHECK(above / count_above == Approx(below / count_below).epsilon(0.15));
    CHECK(count_above > 6 * count_below);
}

TEST_CASE("Very few triangles still make a closed surface that faces outwards") {
    for (const int triangles : {4, 12, 20, 50}) {
        RemeshOptions options;
        options.triangles = triangles;
        const Mesh mesh = remesh(radial_mesh(unit_sphere, 2.0, 3), unit_sphere, options);
        CHECK(mesh.triangle_count() == triangles);
        CHECK(euler_characteristic(connectivity(mesh.F, mesh.vertex_count())) == 2);
        CHECK(signed_volume(mesh) > 0.0);
    }
}

TEST_CASE("A start that is not closed is refused") {
    Mesh open = torus_grid(12, 8);
    open.F.conservativeResize(open.F.rows() - 1, 3);
    CHECK_THROWS_AS(remesh(open, torus), InvalidMesh);
}

TEST_CASE("Projection finds the point of the surface to rounding") {
    const Eigen::Vector3d p(0.9, 0.5, 0.3);
    const ImplicitPoint found = project(unit_sphere, p);
    CHECK((found.position - p.normalized()).norm() < 1e-15);
    CHECK((found.normal - p.normalized()).norm() < 1e-15);
    const ImplicitPoint far = project(unit_sphere, 1e6 * p);
    CHECK((far.position - p.normalized()).norm() < 1e-14);
}

TEST_CASE("A field without a zero is refused") {
    const ImplicitSurface nowhere = [](const Eigen::Vector3d& p) -> FieldSample {
        return {p.squaredNorm() + 1, 2 * p};
    };
    CHECK_THROWS_AS(project(nowhere, Eigen::Vector3d(1, 1, 1)), SolverFailure);
    CHECK_THROWS_AS(radial_mesh(nowhere, 2.0, 1), SolverFailure);
    CHECK_THROWS_AS(radial_mesh(unit_sphere, 0.9, 1), SolverFailure);
}
