#include "morph/parameterization/sphere_map.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numbers>

#include "morph/exact/predicates.h"
#include "morph/mesh/admit.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/io.h"
#include "morph/parameterization/border_union.h"
#include "morph/parameterization/decimation.h"
#include "morph/parameterization/fill.h"
#include "morph/parameterization/half_edges.h"
#include "morph/parameterization/sphere_border.h"
#include "morph/parameterization/sphere_energy.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

namespace {

constexpr double kSphere = 4.0 * std::numbers::pi;

int exact_flips(const Mesh& mesh, const Points& rays) {
    int flips = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f)
        flips += orientation(rays.row(mesh.F(f, 0)), rays.row(mesh.F(f, 1)), rays.row(mesh.F(f, 2))) <= 0;
    return flips;
}

/// Sum of interior angles minus pi, per triangle: the solid angles by another formula than the library's.
double covered(const Mesh& mesh, const Points& rays) {
    double sum = 0.0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        double angles = -std::numbers::pi;
        for (int k = 0; k < 3; ++k) {
            const Ray a = rays.row(mesh.F(f, k)), b = rays.row(mesh.F(f, (k + 1) % 3)),
                      c = rays.row(mesh.F(f, (k + 2) % 3));
            const Ray to_b = a.cross(b - a), to_c = a.cross(c - a);
            angles += std::atan2(to_b.cross(to_c).norm(), to_b.dot(to_c));
        }
        sum += angles;
    }
    return sum;
}

void check_map(const Mesh& mesh, const SphereMap& map, double domain = kSphere) {
    REQUIRE(map.rays.rows() == mesh.vertex_count());
    CHECK(exact_flips(mesh, map.rays) == 0);
    CHECK(map.quality.flipped == 0);
    CHECK(map.solid_angle == Approx(domain).epsilon(1e-9));
    CHECK((map.rays.rowwise().norm().array() - 1.0).abs().maxCoeff() < 1e-14);
}

struct Locked {
    Mesh mesh;
    std::vector<int> loop;
    Points border;
    SphereMap map;
    double domain;  ///< what the border leaves of the sphere
};

Locked lock(const Mesh& mesh) {
    Locked result;
    const auto loops = boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count()));
    result.loop = loops.at(0);
    const Mesh filled = fill_openings(mesh, {loops.begin() + 1, loops.end()}).mesh;
    result.mesh = split_chords(filled, result.loop).mesh;
    const double share = cap_share(filled, result.loop);
    result.border =
        locked_border(arc_length_angles(loop_points(mesh, result.loop), 0), locked_height(share, share));
    result.map = sphere_map(result.mesh, result.loop, result.border);
    // The cap as triangles with the south pole, each by Girard's formula.
    Mesh cap;
    const auto n = static_cast<int>(result.loop.size());
    cap.V = result.border;
    cap.V.conservativeResize(n + 1, 3);
    cap.V.row(n) << 0, 0, -1;
    cap.F.resize(n, 3);
    for (int k = 0; k < n; ++k) cap.F.row(k) << (k + 1) % n, k, n;
    result.domain = kSphere - covered(cap, cap.V);
    return result;
}

void check_locked(const Locked& locked) {
    check_map(locked.mesh, locked.map, locked.domain);
    for (std::size_t k = 0; k < locked.loop.size(); ++k)
        CHECK(locked.map.rays.row(locked.loop[k]) == locked.border.row(static_cast<Eigen::Index>(k)));
}

Mesh tetrahedron() {
    return disks::from({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                       {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
}

/// Closes the border of a disk mesh with a fan.
Mesh capped(const Mesh& disk) {
    return fill_openings(disk, boundary_loops(disk, connectivity(disk.F, disk.vertex_count()))).mesh;
}

std::vector<std::filesystem::path> demo_meshes() {
    const std::filesystem::path folder = AUTOMORPH_DEMO_MESHES;
    std::vector<std::filesystem::path> files;
    if (!std::filesystem::exists(folder)) {
        WARN("no demo meshes in " << folder << ": install libcgal-demo and link its data/meshes there");
        return files;
    }
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".off") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace

TEST_CASE("a collapse and its undo restore the half-edges to the last number") {
    const Mesh mesh = ellipsoid({1, 1, 0.7}, {.triangles = 400});
    const HalfEdges before = half_edges(mesh.F, mesh.vertex_count());
    HalfEdges work = before;
    const std::vector<int> collapses = decimate(work, mesh.V, {});
    CHECK(static_cast<int>(collapses.size()) == mesh.vertex_count() - 4);
    for (auto h = collapses.rbegin(); h != collapses.rend(); ++h) work.undo(*h);
    CHECK(work.origin == before.origin);
    CHECK(work.opposite == before.opposite);
    CHECK(work.valence == before.valence);
    for (int v = 0; v < mesh.vertex_count(); ++v)
        CHECK(work.origin[static_cast<std::size_t>(work.out[static_cast<std::size_t>(v)])] == v);
}

TEST_CASE("half-edges of what is not closed are refused") {
    CHECK_THROWS_AS(half_edges(disks::flat(2).F, disks::flat(2).vertex_count()), InvalidMesh);
    Mesh turned = tetrahedron();
    turned.F.row(0) << 0, 1, 2;
    CHECK_THROWS_AS(half_edges(turned.F, 4), InvalidMesh);
}

TEST_CASE("the energy of a star has the derivatives its Newton step is made of, and 4 A for an isometry") {
    // A small star on the sphere against its own chords: each triangle is nearly isometric.
    const double r = 1e-3;
    const Ray x(0, 0, 1);
    std::vector<Ray> ring;
    for (int k = 0; k < 6; ++k)
        ring.push_back(Ray(r * std::cos(k * 1.0471975512), r * std::sin(k * 1.0471975512), 1).normalized());
    SphereStar star;
    star.reset(x);
    double area = 0.0;
    for (std::size_t k = 0; k < 6; ++k) {
        const TriangleMetric metric = triangle_metric(x, ring[k], ring[(k + 1) % 6], 1e-20);
        area += 2.0 * metric.half_area;
        star.add(ring[k], metric, 0);
    }
    star.close();
    CHECK(star.energy(0, 0) == Approx(4.0 * area).epsilon(1e-5));
    CHECK(star.newton().energy == Approx(star.energy(0, 0)).epsilon(1e-12));
    // Off its place the vertex is led back to within a second-order error.
    SphereStar off;
    const Ray moved = Ray(0.1 * r, -0.05 * r, 1).normalized();
    off.reset(moved);
    for (std::size_t k = 0; k < 6; ++k)
        off.add(ring[k], triangle_metric(x, ring[k], ring[(k + 1) % 6], 1e-20), 0);
    off.close();
    const SphereStar::Step step = off.newton();
    CHECK(step.predicted > 0.0);
    CHECK((off.ray(step.s, step.t) - x).norm() < 0.03 * r);
    // Beyond the ring there is no valid place.
    CHECK(std::isinf(star.energy(1.2 * r, 0)));
}

TEST_CASE("a sphere is mapped with little distortion, any ellipsoid or star without a flip") {
    const Mesh sphere = ellipsoid({2, 2, 2}, {.triangles = 2000});
    const SphereMap round = sphere_map(sphere);
    check_map(sphere, round);
    CHECK(round.quality.p01 > 0.9);
    CHECK(covered(sphere, round.rays) == Approx(kSphere).epsilon(1e-9));
    // An isometry of the sphere: angles between vertices are kept.
    double worst = 0.0;
    for (int v = 1; v < sphere.vertex_count(); ++v) {
        const double cosine = sphere.V.row(0).dot(sphere.V.row(v)) / 4.0;
        worst = std::max(worst, std::abs(cosine - round.rays.row(0).dot(round.rays.row(v))));
    }
    CHECK(worst < 0.05);

    for (const Mesh& mesh : {ellipsoid({1, 0.2, 0.05}, {.triangles = 3000}), star({}, {.triangles = 3000})}) {
        const SphereMap map = sphere_map(mesh);
        check_map(mesh, map);
        CHECK(map.quality.p01 > 0.1);
    }
}

TEST_CASE("the smallest closed meshes are mapped") {
    check_map(tetrahedron(), sphere_map(tetrahedron()));
    for (const int n : {3, 4, 7}) {
        const Mesh mesh = capped(disks::cone(disks::polygon(n).V, 1.0));  // two cones base to base
        check_map(mesh, sphere_map(mesh));
    }
}

TEST_CASE("shapes that no other map survives are mapped without a flip") {
    Mesh mesh = ellipsoid({1, 0.8, 0.6}, {.triangles = 1500});
    const auto check = [](const Mesh& shape) { check_map(shape, sphere_map(shape)); };
    SECTION("edges of no length, triangles without area") {
        for (int v = 1; v < 40; ++v) mesh.V.row(mesh.F(v, 0)) = mesh.V.row(mesh.F(v, 1));
        check(mesh);
    }
    SECTION("all but one vertex in one place") {
        const Eigen::RowVector3d place = mesh.V.row(0);
        mesh.V.rowwise() = place;
        mesh.V.row(mesh.F(0, 0)) << 1, 0, 0;
        mesh.V.row(mesh.F(0, 1)) << 0, 1, 0;
        check(mesh);
    }
    SECTION("flat") {
        mesh.V.col(2).setZero();
        check(mesh);
    }
    SECTION("random positions") {
        std::mt19937_64 random(5);
        for (Eigen::Index i = 0; i < mesh.V.size(); ++i)
            mesh.V.data()[i] = static_cast<double>(random() >> 11) * 0x1.0p-53;
        check(mesh);
    }
    SECTION("hairs 30 radii long") {
        for (int v = 0; v < mesh.vertex_count(); v += 20) mesh.V.row(v) *= 30.0;
        check(mesh);
    }
    SECTION("coordinates far away and tiny") {
        mesh.V *= 1e-7;
        mesh.V.rowwise() += Eigen::RowVector3d(10, -20, 30);
        check(mesh);
    }
    SECTION("fingers") {
        check(capped(disks::finger(40, 3.0)));
        check(capped(disks::finger(200, 3.0)));
    }
    SECTION("vertices of high valence") {
        Points loop(500, 3);
        for (int k = 0; k < 500; ++k) loop.row(k) << std::cos(k * 0.0125664), std::sin(k * 0.0125664), 0.0;
        check(capped(disks::cone(loop, 2.0)));
    }
    SECTION("nested triangles 1000 deep") {
        // Each vertex splits a triangle at the one before: valences of the order of the depth.
        std::vector<Eigen::RowVector3d> V{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        std::vector<Eigen::RowVector3i> F{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
        for (int k = 0; k < 1000; ++k) {
            const Eigen::RowVector3i f = F.back();
            F.pop_back();
            const int v = static_cast<int>(V.size());
            V.push_back((V[static_cast<std::size_t>(f[0])] + V[static_cast<std::size_t>(f[1])] +
                         V[static_cast<std::size_t>(f[2])]) /
                        3.0);
            F.emplace_back(f[0], f[1], v);
            F.emplace_back(f[1], f[2], v);
            F.emplace_back(f[2], f[0], v);
        }
        check(disks::from(V, F));
    }
}

TEST_CASE("what has no map onto the sphere is refused, with what was found") {
    Mesh line = ellipsoid({1, 1, 1}, {.triangles = 200});
    line.V.rightCols<2>().setZero();
    CHECK_THROWS_AS(sphere_map(line), InvalidMesh);
    CHECK_THROWS_AS(sphere_map(disks::flat(3)), InvalidMesh);

    const Mesh disk = disks::flat(3);
    const auto loop = boundary_loops(disk, connectivity(disk.F, disk.vertex_count())).at(0);
    const Points border = locked_border(arc_length_angles(loop_points(disk, loop), 0), -0.5);
    CHECK_THROWS_AS(sphere_map(disk, loop, border.topRows(5)), InvalidMesh);
    CHECK_THROWS_AS(sphere_map(disk, loop, border.colwise().reverse()), InvalidMesh);  // the wrong way round
    const Mesh polygon = disks::polygon(5);                                            // no inner vertex
    const auto around = boundary_loops(polygon, connectivity(polygon.F, 5)).at(0);
    CHECK_THROWS_AS(
        sphere_map(polygon, around, locked_border(arc_length_angles(loop_points(polygon, around), 0), -0.5)),
        InvalidMesh);
}

TEST_CASE("the map is the same every time, and does not depend on scale and place") {
    const Mesh mesh = star({}, {.triangles = 1200});
    const SphereMap first = sphere_map(mesh);
    CHECK(first.rays == sphere_map(mesh).rays);
    Mesh other = mesh;
    other.V *= 1024.0;  // exact
    CHECK((sphere_map(other).rays - first.rays).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("the quality of a map onto the sphere: shares of solid angle over shares of area") {
    Mesh octahedron;
    octahedron.V.resize(6, 3);
    octahedron.V << 1, 0, 0, 0, 1, 0, 0, 0, 1, -1, 0, 0, 0, -1, 0, 0, 0, -1;
    octahedron.F.resize(8, 3);
    octahedron.F << 0, 1, 2, 1, 3, 2, 3, 4, 2, 4, 0, 2, 1, 0, 5, 3, 1, 5, 4, 3, 5, 0, 4, 5;
    const Points rays = 3.0 * octahedron.V;  // the length of rays does not matter
    MapQuality quality = sphere_map_quality(octahedron, rays);
    CHECK(quality.flipped == 0);
    CHECK(quality.p01 == Approx(1.0).epsilon(1e-12));
    CHECK(quality.area.worst == Approx(1.0).epsilon(1e-12));
    CHECK(quality.angle.worst == Approx(1.0).epsilon(1e-12));
    CHECK(total_solid_angle(octahedron.F, rays) == Approx(kSphere).epsilon(1e-12));
    octahedron.V.row(2) *=
        3.0;  // the four upper triangles get area sqrt(19) / 2, the others have sqrt(3) / 2
    quality = sphere_map_quality(octahedron, rays);
    CHECK(quality.p01 == Approx(0.5 * (1.0 + std::sqrt(3.0 / 19.0))).epsilon(1e-12));
    // The upper ones have 1/2 of the sphere for more than half of the surface; their height over the base,
    // from sqrt(19) / sqrt(2), becomes sqrt(3) / sqrt(2).
    CHECK(quality.area.median == Approx(2.0 / (1.0 + std::sqrt(3.0 / 19.0))).epsilon(1e-12));
    CHECK(quality.area.worst == Approx(0.5 * (1.0 + std::sqrt(19.0 / 3.0))).epsilon(1e-12));
    CHECK(quality.angle.median == Approx(std::sqrt(19.0 / 3.0)).epsilon(1e-12));
    // One triangle, inside out.
    Mesh turned = octahedron;
    turned.F.row(0) << 1, 0, 2;
    CHECK(sphere_map_quality(turned, rays).flipped == 1);
}

TEST_CASE("the height of a locked border follows the caps' share of the area") {
    CHECK(locked_height(0.5, 0.5) == Approx(0.0).margin(1e-15));
    CHECK(locked_height(0.1, 0.3) == Approx(-0.6));
    CHECK(locked_height(0.0, 0.0) == Approx(-0.996));
    CHECK(locked_height(0.9, 0.9) == Approx(0.0).margin(1e-15));
    const Mesh flat = disks::flat(20);  // the cap is as large as the disk
    CHECK(cap_share(flat, boundary_loops(flat, connectivity(flat.F, flat.vertex_count())).at(0)) ==
          Approx(0.5));
}

TEST_CASE("chords are split and the surface stays the same") {
    for (const Mesh& mesh :
         {disks::polygon(4), disks::polygon(9), disks::grid(5, 3), disks::flat(1), disks::grid(1, 1)}) {
        const auto loop = boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count())).at(0);
        const ChordFreeMesh split = split_chords(mesh, loop);
        const Connectivity topology = connectivity(split.mesh.F, split.mesh.vertex_count());
        CHECK(euler_characteristic(topology) == 1);
        CHECK(boundary_loops(split.mesh, topology) ==
              boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count())));
        CHECK(triangle_areas(split.mesh).sum() == Approx(triangle_areas(mesh).sum()).epsilon(1e-12));
        CHECK(split_chords(split.mesh, loop).midpoint.empty());
        check_locked(lock(mesh));
    }
}

TEST_CASE("open meshes keep their border where it is locked, whatever its share of the surface") {
    for (const double height : {0.0, 1.0, 5.0}) {
        const Locked locked = lock(disks::dome(15, height));
        check_locked(locked);
        CHECK(locked.map.quality.p01 > 0.1);
    }
    check_locked(lock(disks::dome(15, 40.0)));
    check_locked(lock(disks::finger(40, 3.0)));
    check_locked(lock(disks::finger(200, 3.0)));
    Mesh spoiled = disks::dome(10, 1.0);
    spoiled.V.row(3) = spoiled.V.row(4);
    spoiled.V.row(50) *= 30.0;
    check_locked(lock(spoiled));
}

TEST_CASE("every mesh of genus 0 among the demo meshes is mapped one-to-one", "[sweep]") {
    constexpr int kMostTriangles = 60000;
    int closed = 0, open = 0;
    for (const auto& file : demo_meshes()) {
        Mesh mesh;
        bool is_closed = false;
        try {
            const AdmittedMesh admitted = admit(read_mesh(file), file.filename().string());
            mesh = admitted.mesh;
            is_closed = admitted.admitted.closed;
        } catch (const Error&) {
            continue;  // genus, several components: tested elsewhere
        }
        if (mesh.triangle_count() > kMostTriangles || mesh.triangle_count() < 2) continue;
        INFO(file.filename());
        if (is_closed) {
            const SphereMap map = sphere_map(mesh);
            check_map(mesh, map);
            CHECK(map.quality.p01 > 0.07);
            ++closed;
        } else {
            const Locked locked = lock(mesh);
            check_locked(locked);
            CHECK(locked.map.quality.p01 > 0.08);
            ++open;
        }
    }
    if (!demo_meshes().empty()) {
        CHECK(closed >= 50);
        CHECK(open >= 30);
    }
}
