#include "morph/sphere_alignment/align_spheres.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/parameterization/border_union.h"
#include "morph/parameterization/map_quality.h"
#include "morph/parameterization/sphere_border.h"
#include "morph/parameterization/sphere_map.h"
#include "morph/shapes/shapes.h"
#include "morph/sphere_alignment/guarded_move.h"
#include "morph/sphere_alignment/movable_map.h"
#include "morph/sphere_alignment/smooth_field.h"
#include "morph/sphere_alignment/surface_matches.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

namespace {

const std::vector<int> kNoLoop;

std::vector<char> no_filling(const Mesh& mesh) {
    return std::vector<char>(static_cast<std::size_t>(mesh.triangle_count()), 0);
}

/// A point of the sphere for each direction of an even set.
Points spiral(int count) {
    Points rays(count, 3);
    for (int k = 0; k < count; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / count, angle = 2.399963 * k, r = std::sqrt(1.0 - z * z);
        rays.row(k) << r * std::cos(angle), r * std::sin(angle), z;
    }
    return rays;
}

}  // namespace

TEST_CASE("a constant field is reproduced, a linear one nearly, and far from all places there is none") {
    const Points places = spiral(800);
    const Eigen::VectorXd weights = Eigen::VectorXd::Ones(800);
    Points vectors(800, 3);
    vectors.rowwise() = Eigen::RowVector3d(0.3, -0.2, 0.1);
    for (const double width : {0.13, 0.3, 0.6}) {
        const SmoothField constant(places, vectors, weights, width);
        const SmoothField linear(places, places, weights, width);
        for (const auto& x :
             {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-0.3, 0.2, -0.9)}) {
            const Eigen::Vector3d unit = x.normalized();
            CHECK((constant(unit) - Eigen::Vector3d(0.3, -0.2, 0.1)).norm() < 0.03 * 0.4);
            // The mean of x over a Gaussian about it falls short by width^2.
            CHECK((linear(unit) - (1.0 - width * width) * unit).norm() < 0.1);
        }
    }
    const SmoothField cap(places.topRows(50), vectors.topRows(50), weights.head(50), 0.13);
    CHECK(cap(Eigen::Vector3d(0, 0, 1)).norm() > 0.3);
    CHECK(cap(Eigen::Vector3d(0, 0, -1)).norm() == 0.0);
}

TEST_CASE(
    "a guarded move goes as far as all triangles stay positive, and all the way where nothing is in the "
    "way") {
    const Mesh mesh = ellipsoid({1, 1, 1}, {.triangles = 600});
    Points rays = mesh.V;
    rays.rowwise().normalize();
    REQUIRE(flipped_triangles(mesh.F, rays) == 0);

    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Points turned = (rays * turn.transpose()).rowwise().normalized();
    const GuardedMove free = move_guarded(mesh.F, rays, turned);
    CHECK(free.rays == turned);
    CHECK(free.shortened == 0);

    Points wild = rays;  // every tenth vertex to the far end of its surroundings
    for (int v = 0; v < mesh.vertex_count(); v += 10)
        wild.row(v) = (rays.row(v) + Eigen::RowVector3d(0.5, -0.3, 0.4)).normalized();
    REQUIRE(flipped_triangles(mesh.F, wild) > 0);
    const GuardedMove guarded = move_guarded(mesh.F, rays, wild);
    CHECK(flipped_triangles(mesh.F, guarded.rays) == 0);
    CHECK(guarded.shortened > 0);
    CHECK(total_solid_angle(mesh.F, guarded.rays) == Approx(4.0 * std::numbers::pi));
    for (int v = 1; v < 10; ++v) CHECK(guarded.rays.row(v) == rays.row(v));  // who is to stay stays
}

TEST_CASE("a map does not go twice around the sphere, though no triangle flips") {
    constexpr int kRing = 12;
    Mesh mesh{Points(kRing + 2, 3), Triangles(2 * kRing, 3)};  // a double cone over a ring
    Points twice(kRing + 2, 3);
    for (int k = 0; k < kRing; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / kRing;
        mesh.V.row(k) << std::cos(angle), std::sin(angle), 0.0;
        twice.row(k) << std::cos(2.0 * angle), std::sin(2.0 * angle), 0.0;
        mesh.F.row(2 * k) << k, (k + 1) % kRing, kRing;
        mesh.F.row(2 * k + 1) << (k + 1) % kRing, k, kRing + 1;
    }
    mesh.V.bottomRows(2) << 0, 0, 1, 0, 0, -1;
    twice.bottomRows(2) = mesh.V.bottomRows(2);
    REQUIRE(flipped_triangles(mesh.F, twice) == 0);
    CHECK(covering_degree(mesh.F, mesh.V) == 1);
    CHECK(covering_degree(mesh.F, twice) == 2);

    MovableMap map(mesh, kNoLoop, mesh.V);
    map.move(twice);
    CHECK(flipped_triangles(mesh.F, map.rays()) == 0);
    CHECK(covering_degree(mesh.F, map.rays()) == 1);
    map.follow(twice);
    CHECK(covering_degree(mesh.F, map.rays()) == 1);
    MovableMap covers_twice(mesh, kNoLoop, twice);
    CHECK_THROWS_AS(covers_twice.move(twice), SolverFailure);
}

TEST_CASE("a map follows another all the way, and as far as it can where that one is folded") {
    const Mesh mesh = star({}, {.triangles = 1500});
    const Points rays = sphere_map(mesh).rays;
    // Another valid map: the same, turned, and squeezed towards a pole by a one-to-one map of the sphere.
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 1).normalized()).toRotationMatrix();
    Points other = rays * turn.transpose();
    other.rightCols<1>() *= 1.7;
    other.rowwise().normalize();
    REQUIRE(flipped_triangles(mesh.F, other) == 0);
    MovableMap map(mesh, kNoLoop, rays);
    CHECK(map.follow(other) == 0);
    CHECK(map.rays() == other);

    Points folded = other;
    for (int v = 0; v < mesh.vertex_count(); v += 50)
        folded.row(v) = folded.row((v + 25) % mesh.vertex_count());
    REQUIRE(flipped_triangles(mesh.F, folded) > 0);
    const int late = map.follow(folded);
    CHECK(late > 0);
    CHECK(late < 0.2 * mesh.vertex_count());
    CHECK(flipped_triangles(mesh.F, map.rays()) == 0);
    CHECK(total_solid_angle(mesh.F, map.rays()) == Approx(4.0 * std::numbers::pi));
    int in_place = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) in_place += map.rays().row(v) == folded.row(v);
    CHECK(in_place >= mesh.vertex_count() - late);
}

TEST_CASE("matches of a shape with itself are the same points; what is ignored has none") {
    const Mesh mesh = star({}, {.triangles = 1500});
    std::vector<char> lower = no_filling(mesh);
    for (int f = 0; f < mesh.triangle_count(); ++f)
        lower[static_cast<std::size_t>(f)] = mesh.V(mesh.F(f, 0), 0) < 0.0;
    const std::vector<char> all = no_filling(mesh);
    const SurfaceMatches matches = match_surfaces({mesh, all}, {mesh, lower}, {}, 3);
    REQUIRE(matches.on_a.size() > 300);
    double distance = 0.0;
    for (std::size_t k = 0; k < matches.on_a.size(); ++k) {
        CHECK(mesh.V(matches.on_b[k].corners[0], 0) >= 0.0);  // not lower
        Eigen::RowVector3d difference = Eigen::RowVector3d::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
            difference += matches.on_a[k].weights[c] * mesh.V.row(matches.on_a[k].corners[c]) -
                          matches.on_b[k].weights[c] * mesh.V.row(matches.on_b[k].corners[c]);
        }
        distance += difference.norm() / static_cast<double>(matches.on_a.size());
    }
    CHECK(distance < 0.03);  // the spacing of the sample is about 0.02
}

TEST_CASE("two tessellations of one shape meet on the sphere") {
    const StarParameters parameters;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.9, Eigen::Vector3d(-1, 2, 0.5).normalized()).toRotationMatrix();
    const Mesh a = star(parameters, {.triangles = 3000, .seed = 1});
    const Mesh b =
        star(parameters, {.triangles = 2500, .seed = 2, .rotation = turn, .translation = {1, 2, 3}});
    Registration truth;
    truth.R = turn;
    truth.t = {1, 2, 3};
    const Points rays_a = sphere_map(a).rays, rays_b = sphere_map(b).rays;
    const std::vector<char> none_a = no_filling(a), none_b = no_filling(b);
    const MappedMesh map_a{a, kNoLoop, rays_a}, map_b{b, kNoLoop, rays_b};
    const SurfaceMatches matches = match_surfaces({a, none_a}, {b, none_b}, truth, 1);
    const AlignedSpheres aligned = align_spheres(map_a, map_b, matches);
    CHECK(flipped_triangles(a.F, aligned.rays_a) == 0);
    CHECK(flipped_triangles(b.F, aligned.rays_b) == 0);
    CHECK(total_solid_angle(b.F, aligned.rays_b) == Approx(4.0 * std::numbers::pi));
    CHECK(aligned.matches > 1500);
    CHECK(aligned.rotated < aligned.before);
    CHECK(aligned.after < aligned.rotated);
    CHECK(aligned.after < 0.03);
    const AlignedSpheres again = align_spheres(map_a, map_b, matches);
    CHECK(again.rays_a == aligned.rays_a);
    CHECK(again.rays_b == aligned.rays_b);
}

TEST_CASE("a locked border stays while the inside is warped") {
    const Mesh a = disks::dome(14, 2.0), b = disks::dome(16, 2.0, 0.1, 7);
    const auto loop_of = [](const Mesh& mesh) {
        return boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count())).at(0);
    };
    const std::vector<int> loop_a = loop_of(a), loop_b = loop_of(b);
    const Points circle_a = locked_border(arc_length_angles(loop_points(a, loop_a), 0), -0.5),
                 circle_b = locked_border(arc_length_angles(loop_points(b, loop_b), 0), -0.5);
    const std::vector<char> none_a = no_filling(a), none_b = no_filling(b);
    const AlignedSpheres aligned = align_spheres({a, loop_a, sphere_map(a, loop_a, circle_a).rays},
                                                 {b, loop_b, sphere_map(b, loop_b, circle_b).rays},
                                                 match_surfaces({a, none_a}, {b, none_b}, {}, 1));
    for (std::size_t k = 0; k < loop_a.size(); ++k)
        CHECK(aligned.rays_a.row(loop_a[k]) == circle_a.row(static_cast<Eigen::Index>(k)));
    for (std::size_t k = 0; k < loop_b.size(); ++k)
        CHECK(aligned.rays_b.row(loop_b[k]) == circle_b.row(static_cast<Eigen::Index>(k)));
    CHECK(flipped_triangles(a.F, aligned.rays_a) == 0);
    CHECK(flipped_triangles(b.F, aligned.rays_b) == 0);
    CHECK(aligned.rotated == aligned.before);
    CHECK(aligned.after < aligned.rotated);
}
