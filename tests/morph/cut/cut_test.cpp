#include "morph/cut/cut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "morph/mesh/admit.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/io.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;
using Eigen::Vector3d;

namespace {

/// A closed tube of square section along a polyline of unit steps: bends that one plane meets several times.
Mesh tube(const std::vector<Vector3d>& path) {
    const auto n = static_cast<int>(path.size());
    Mesh mesh;
    mesh.V.resize(4 * n, 3);
    const Vector3d side(0, 0, 0.3);
    for (int i = 0; i < n; ++i) {
        const Vector3d along = (path[static_cast<std::size_t>(std::min(i + 1, n - 1))] -
                                path[static_cast<std::size_t>(std::max(i - 1, 0))])
                                   .normalized();
        const Vector3d across = 0.3 * along.cross(Vector3d::UnitZ());
        const Vector3d p = path[static_cast<std::size_t>(i)];
        mesh.V.row(4 * i) = p - across - side;
        mesh.V.row(4 * i + 1) = p + across - side;
        mesh.V.row(4 * i + 2) = p + across + side;
        mesh.V.row(4 * i + 3) = p - across + side;
    }
    mesh.F.resize(8 * (n - 1) + 4, 3);
    int f = 0;
    for (int i = 0; i + 1 < n; ++i) {
        for (int k = 0; k < 4; ++k) {
            const int a = 4 * i + k, b = 4 * i + (k + 1) % 4;
            mesh.F.row(f++) << a, b, b + 4;
            mesh.F.row(f++) << a, b + 4, a + 4;
        }
    }
    mesh.F.row(f++) << 0, 2, 1;
    mesh.F.row(f++) << 0, 3, 2;
    const int last = 4 * (n - 1);
    mesh.F.row(f++) << last, last + 1, last + 2;
    mesh.F.row(f++) << last, last + 2, last + 3;
    if (signed_volume(mesh) < 0) mesh.F.col(1).swap(mesh.F.col(2));
    return mesh;
}

std::vector<Vector3d> u_shape() {
    std::vector<Vector3d> path;
    for (int i = 0; i < 5; ++i) path.emplace_back(0, 4 - i, 0);
    for (int i = 1; i < 4; ++i) path.emplace_back(i, 0, 0);
    for (int i = 0; i < 5; ++i) path.emplace_back(4, i, 0);
    return path;
}

/// Area and volume add up, halves are disks with the cut as border, and both hold the same cut points.
void check_cut(const Mesh& mesh, const Plane& plane) {
    const CutMesh result = cut(mesh, plane);
    const double size = bounding_box_diagonal(mesh.V);
    double area = 0.0;
    for (const int which : {0, 1}) {
        const Half& half = result.halves[static_cast<std::size_t>(which)];
        const Connectivity topology = connectivity(half.mesh.F, half.mesh.vertex_count());
        const auto loops = boundary_loops(half.mesh, topology);
        REQUIRE(euler_characteristic(topology) == 1);
        REQUIRE(loops.size() == 1);
        REQUIRE(loops[0].size() == half.loop.size());
        // The loop runs in the direction of the border: each of its steps is a step of boundary_loops.
        const auto start = std::find(loops[0].begin(), loops[0].end(), half.loop[0]) - loops[0].begin();
        for (std::size_t k = 0; k < half.loop.size(); ++k) {
            REQUIRE(loops[0][(static_cast<std::size_t>(start) + k) % half.loop.size()] == half.loop[k]);
        }
        for (int v = 0; v < half.mesh.vertex_count(); ++v) {
            const int origin = half.vertex[static_cast<std::size_t>(v)];
            const double distance = plane.normal.dot(half.mesh.V.row(v)) - plane.offset;
            if (origin >= 0) {
                REQUIRE(half.mesh.V.row(v) == mesh.V.row(origin));
                REQUIRE((which == 0 ? distance : -distance) > -kPlaneNudge * size);
            } else {
                REQUIRE(std::abs(distance) <= (1 + 1e-9) * kPlaneNudge * size);
            }
        }
        area += triangle_areas(half.mesh).sum();
    }
    CHECK(area == Approx(triangle_areas(mesh).sum()).epsilon(1e-9));

    const Half &above = result.halves[0], &below = result.halves[1];
    const std::size_t n = above.loop.size();
    REQUIRE(n == result.points.size());
    for (std::size_t k = 0; k < n; ++k) {
        const int v = above.loop[k], w = below.loop[(n - k) % n];
        REQUIRE(above.vertex[static_cast<std::size_t>(v)] == -1 - static_cast<int>(k));
        REQUIRE(below.vertex[static_cast<std::size_t>(w)] == -1 - static_cast<int>(k));
        REQUIRE(above.mesh.V.row(v) == below.mesh.V.row(w));
        REQUIRE(result.points[k].ratio > 0.0);
        REQUIRE(result.points[k].ratio < 1.0);
    }
}

Registration identity(double sigma = 0.1) {
    Registration registration;
    registration.sigma = sigma;
    return registration;
}

}  // namespace

TEST_CASE("a plane through a vertex cuts the same edges however its distance is rounded") {
    const Mesh mesh = ellipsoid({1, 0.8, 0.6}, {.triangles = 600});
    for (int vertex = 0; vertex < mesh.vertex_count(); vertex += 7) {
        const Vector3d through = mesh.V.row(vertex);
        const Vector3d normal = through.unitOrthogonal();
        std::vector<std::size_t> counts;
        for (const double rounding : {0.0, 1e-16, -1e-16, 3e-14, -3e-14})
            counts.push_back(cut(mesh, {normal, normal.dot(through) + rounding}).points.size());
        CHECK(std::count(counts.begin(), counts.end(), counts.front()) == 5);
    }
}

TEST_CASE("a sphere, an ellipsoid and a star are cut into two disks by planes through their middle") {
    const Mesh shapes[] = {ellipsoid({1, 1, 1}, {.triangles = 800}),
                           ellipsoid({2, 1, 0.5}, {.triangles = 1000}), star({}, {.triangles = 2000})};
    for (const Mesh& shape : shapes) {
        check_cut(shape, {Vector3d::UnitZ(), 0.01});
        check_cut(shape, {Vector3d(1, 2, 3).normalized(), 0.05});
    }
}

TEST_CASE("the cut of a sphere is a circle of the length and the areas that geometry says") {
    const Mesh sphere = ellipsoid({1, 1, 1}, {.triangles = 20000});
    const Section s =
        section(sphere, connectivity(sphere.F, sphere.vertex_count()), {Vector3d(0, 0.6, 0.8), 0.5});
    CHECK(s.loops == 1);
    CHECK(s.length == Approx(2 * M_PI * std::sqrt(0.75)).epsilon(0.002));
    CHECK(s.area_above == Approx(M_PI).epsilon(0.02));  // 2 pi h, h = 0.5
    CHECK(s.area_below == Approx(3 * M_PI).epsilon(0.02));
}

TEST_CASE("a plane that passes exactly through vertices is nudged off them") {
    Mesh octahedron;
    octahedron.V.resize(6, 3);
    octahedron.V << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
    octahedron.F.resize(8, 3);
    octahedron.F << 0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5;
    check_cut(octahedron, {Vector3d::UnitZ(), 0.0});
    check_cut(octahedron, {Vector3d::UnitX(), 0.0});
    check_cut(octahedron, {Vector3d(1, 1, 0).normalized(), 0.0});
}

TEST_CASE("a plane that meets a bent tube twice is refused, with the number of curves") {
    const Mesh u = tube(u_shape());
    check_cut(u, {Vector3d::UnitX(), 2.1});
    try {
        cut(u, {Vector3d::UnitY(), 2.1});
        FAIL("two curves must be refused");
    } catch (const SolverFailure& failure) {
        CHECK(std::string(failure.what()).find("2 closed curves") != std::string::npos);
    }
    CHECK_THROWS_AS(cut(u, (Plane{Vector3d::UnitX(), 99.0})), SolverFailure);
}

TEST_CASE("the chosen planes pass through both centres and cut both shapes into disks") {
    const Mesh u = tube(u_shape());
    const CutPlanes planes = choose_cut(u, u, identity());
    for (const Plane* plane : {&planes.source, &planes.target}) {
        CHECK(plane->normal.norm() == Approx(1.0));
        CHECK(plane->normal.dot(centre_of_mass(u)) == Approx(plane->offset));
    }
    CHECK(planes.matches_tried >= 1);
    check_cut(u, planes.source);
    check_cut(u, planes.target);
}

TEST_CASE("the target's plane is the source's under the rotation") {
    const Eigen::Matrix3d R = Eigen::AngleAxisd(1.0, Vector3d(1, 1, 0).normalized()).toRotationMatrix();
    const Mesh source = ellipsoid({1.0, 0.8, 0.5}, {.triangles = 600});
    Mesh target = source;
    target.V = source.V * R.transpose();
    Registration registration = identity(0.01);
    registration.R = R;
    const CutPlanes planes = choose_cut(source, target, registration);
    CHECK(planes.source_vertex == planes.target_vertex);
    CHECK((R * planes.source.normal - planes.target.normal).norm() < 1e-6);
    CHECK(std::abs(planes.source.normal.dot(source.V.row(planes.source_vertex)) - planes.source.offset) <
          1e-9);
}

TEST_CASE("unregistered planes have the same normal in both files' axes") {
    const Mesh a = ellipsoid({1, 0.8, 0.6}, {.triangles = 500});
    const Mesh b = star({}, {.triangles = 800, .translation = {4, 0, 0}});
    const CutPlanes planes = unregistered_cut(a, b);
    CHECK(planes.source.normal == planes.target.normal);
    CHECK(planes.target.normal.dot(centre_of_mass(b)) == Approx(planes.target.offset));
    check_cut(a, planes.source);
    check_cut(b, planes.target);
}

TEST_CASE("closed meshes of CGAL's demo are cut") {
    const std::filesystem::path folder(AUTOMORPH_DEMO_MESHES);
    if (!std::filesystem::exists(folder)) {
        WARN("skipped: " << folder << " is absent; ./run test fetches it");
        return;
    }
    int closed = 0;
    for (const char* name :
         {"pig.off", "cow.off", "bull.off", "dino.off", "camel.off", "homer.off", "mushroom.off"}) {
        if (!std::filesystem::exists(folder / name)) continue;
        const AdmittedMesh admitted = admit(read_mesh(folder / name), name);
        if (!admitted.admitted.closed) continue;
        ++closed;
        INFO(name);
        const CutPlanes planes =
            choose_cut(admitted.mesh, admitted.mesh, identity(0.01 * bounding_box_diagonal(admitted.mesh.V)));
        check_cut(admitted.mesh, planes.source);
    }
    CHECK(closed >= 4);
}
