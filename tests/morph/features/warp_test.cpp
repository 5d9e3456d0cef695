#include "morph/features/warp.h"

#include <random>

#include "morph/features/align.h"
#include "tests/catch.h"
#include "tests/morph/features/maps.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

double flat(double, double) {
    return 0.0;
}

Points at(const std::vector<std::array<double, 2>>& places) {
    Points points(static_cast<Eigen::Index>(places.size()), 3);
    for (std::size_t k = 0; k < places.size(); ++k)
        points.row(static_cast<Eigen::Index>(k)) << places[k][0], places[k][1], 1.0;
    return points;
}

/// Vertices nearest to some places.
std::vector<int> vertices(const GraphDisk& disk, const Points& places) {
    std::vector<int> found;
    for (Eigen::Index k = 0; k < places.rows(); ++k)
        found.push_back(nearest(disk.rays, places(k, 0), places(k, 1)));
    return found;
}

AlignOptions unsmoothed(double radius) {
    AlignOptions options;
    options.matching.radius = radius;
    options.matching.scales = {0.0};
    return options;
}

/// What holds of every warp.
void check_warp(const GraphDisk& disk, const std::vector<int>& features, const Points& places,
                const WarpedMap& warped, const WarpOptions& options = {}) {
    CHECK(flipped(disk.mesh.F, warped.rays) == 0);
    for (const int v : disk.loop) CHECK(warped.rays.row(v) == disk.rays.row(v));
    CHECK((warped.rays.col(2).array() == 1.0).all());
    int in_place = 0;
    for (std::size_t k = 0; k < features.size(); ++k) {
        const double distance =
            (warped.rays.row(features[k]) - places.row(static_cast<Eigen::Index>(k))).norm();
        CHECK(distance == Approx(warped.distances[k]).margin(1e-15));
        in_place += distance <= options.tolerance;
    }
    CHECK(in_place == warped.in_place);
}

}  // namespace

TEST_CASE("features that are in place leave the map bit for bit as it is") {
    const GraphDisk disk = graph_disk(12, 0.2, 1, flat);
    const std::vector<int> features{0, 10, 50, 200};
    const WarpedMap warped =
        warp_map(disk.mesh, disk.loop, disk.rays, features, disk.rays(features, Eigen::all));
    CHECK(warped.rays == disk.rays);
    CHECK(warped.in_place == 4);
    CHECK(warped.rounds == 0);
    CHECK(warp_map(disk.mesh, disk.loop, disk.rays, {}, Points(0, 3)).rays == disk.rays);
}

TEST_CASE("features go to their places exactly and drag their neighbours") {
    const GraphDisk disk = graph_disk(30, 0.2, 2, flat);
    const Points from = at({{0.3, 0.2}, {-0.4, 0.1}, {0.0, -0.5}, {-0.1, 0.6}, {0.05, 0.05}});
    const std::vector<int> features = vertices(disk, from);
    Points places = disk.rays(features, Eigen::all);
    const double steps[5][2] = {{0.1, 0.0}, {-0.05, 0.08}, {0.1, 0.1}, {0.0, -0.1}, {-0.06, 0.02}};
    for (int k = 0; k < 5; ++k) places.row(k).head<2>() += Eigen::RowVector2d(steps[k][0], steps[k][1]);
    const WarpedMap warped = warp_map(disk.mesh, disk.loop, disk.rays, features, places);
    check_warp(disk, features, places, warped);
    CHECK(warped.in_place == 5);
    for (int k = 0; k < 5; ++k)
        CHECK(warped.rays.row(features[static_cast<std::size_t>(k)]) == places.row(k));
    // A vertex beside the first feature comes along for most of the way.
    const int beside = nearest(disk.rays, from(0, 0) + 0.04, from(0, 1));
    CHECK(beside != features[0]);
    CHECK(warped.rays(beside, 0) - disk.rays(beside, 0) > 0.05);
}

TEST_CASE("no triangle turns, whatever is asked of random maps") {
    std::mt19937 random(3);
    for (int trial = 0; trial < 40; ++trial) {
        INFO("trial " << trial);
        const GraphDisk disk = graph_disk(8, 0.25, static_cast<unsigned>(trial), flat);
        std::vector<int> features;
        const int inner = disk.mesh.vertex_count() - static_cast<int>(disk.loop.size());
        for (int v = 0; v < inner; ++v)
            if (random() % 10 == 0) features.push_back(v);
        Points places(static_cast<Eigen::Index>(features.size()), 3);
        std::uniform_real_distribution<double> coordinate(-0.7, 0.7);
        for (Eigen::Index k = 0; k < places.rows(); ++k)
            places.row(k) << coordinate(random), coordinate(random), 1.0;
        const WarpedMap warped = warp_map(disk.mesh, disk.loop, disk.rays, features, places);
        check_warp(disk, features, places, warped);
        CHECK(warped.rounds <= 50 * 6);
        CHECK(warped.in_place <
              static_cast<int>(features.size()));  // places in random order cannot all be reached
        CHECK(warped.shortened > 0);
    }
}

TEST_CASE("two features for one place: one of them gets it") {
    const GraphDisk disk = graph_disk(20, 0.2, 5, flat);
    const std::vector<int> features = vertices(disk, at({{-0.2, 0.0}, {0.2, 0.0}}));
    const Points places = at({{0.0, 0.0}, {0.0, 0.0}});
    const WarpedMap warped = warp_map(disk.mesh, disk.loop, disk.rays, features, places);
    check_warp(disk, features, places, warped);
    // Both come near; a triangle between them can be as thin as doubles allow.
    CHECK(warped.distances[0] + warped.distances[1] < 0.2);
    CHECK(warped.rays.row(features[0]) != warped.rays.row(features[1]));
}

TEST_CASE("features of a row in reverse order end with an honest count") {
    const GraphDisk disk = graph_disk(15, 0.1, 6, flat);
    const std::vector<int> features = vertices(disk, at({{-0.6, 0}, {-0.3, 0}, {0, 0}, {0.3, 0}, {0.6, 0}}));
    Points places = disk.rays(features, Eigen::all).colwise().reverse();
    const WarpedMap warped = warp_map(disk.mesh, disk.loop, disk.rays, features, places);
    check_warp(disk, features, places, warped);
    CHECK(warped.reach >= 0.01);
}

TEST_CASE("alignment brings the features of two maps of one surface onto one another") {
    // b is a with a map that is pushed aside in the middle.
    const GraphDisk a = graph_disk(30, 0.0, 1, egg_box);
    GraphDisk b = a;
    for (int v = 0; v < b.rays.rows(); ++v) {
        const double r2 = b.rays.row(v).head<2>().squaredNorm();
        b.rays.row(v).head<2>() += 0.06 * (1.0 - r2) * Eigen::RowVector2d(1.0, 0.5);
    }
    REQUIRE(flipped(b.mesh.F, b.rays) == 0);
    const AlignedMaps aligned = align_features({a.mesh, a.mesh.F, a.loop, a.rays},
                                               {b.mesh, b.mesh.F, b.loop, b.rays}, unsmoothed(0.1));
    CHECK(aligned.candidates_a.size() == 4);
    CHECK(aligned.warps == 1);
    REQUIRE(aligned.matches.size() == 4);
    CHECK(aligned.in_place == 4);
    CHECK(aligned.distance_before > 0.02);
    CHECK(aligned.distance_after == 0.0);
    for (const FeatureMatch& m : aligned.matches) {
        CHECK(m.vertex_a == m.vertex_b);
        CHECK(aligned.rays_a.row(m.vertex_a) == aligned.rays_b.row(m.vertex_b));
        CHECK(aligned.rays_a.row(m.vertex_a) == 0.5 * (a.rays.row(m.vertex_a) + b.rays.row(m.vertex_b)));
    }
    CHECK(flipped(a.mesh.F, aligned.rays_a) == 0);
    CHECK(flipped(b.mesh.F, aligned.rays_b) == 0);
    // Not only the features: the maps as a whole are nearer to one another.
    CHECK((aligned.rays_a - aligned.rays_b).norm() < 0.9 * (a.rays - b.rays).norm());
}

TEST_CASE("features out of reach at first are matched again after the others have brought them near") {
    const GraphDisk a = graph_disk(30, 0.0, 1, egg_box);
    GraphDisk b = a;
    for (int v = 0; v < b.rays.rows(); ++v) {  // a shift that grows from left to right
        const double x = b.rays(v, 0), r2 = b.rays.row(v).head<2>().squaredNorm();
        b.rays(v, 1) += 0.12 * (1.0 + 0.5 * x) * (1.0 - r2);
    }
    REQUIRE(flipped(b.mesh.F, b.rays) == 0);
    const auto aligned = [&](int rematches) {
        AlignOptions options = unsmoothed(0.06);
        options.warping.reach = 1.5;  // the saddles are 1 apart
        options.rematches = rematches;
        return align_features({a.mesh, a.mesh.F, a.loop, a.rays}, {b.mesh, b.mesh.F, b.loop, b.rays},
                              options);
    };
    const AlignedMaps once = aligned(0), again = aligned(3);
    CHECK(once.warps == 1);
    REQUIRE(once.matches.size() > 0);
    REQUIRE(once.matches.size() < 4);
    CHECK(again.warps > 1);
    CHECK(again.matches.size() == 4);
    CHECK(again.in_place == 4);
    for (const FeatureMatch& m : again.matches) CHECK(m.vertex_a == m.vertex_b);
}

TEST_CASE("surfaces without features keep their maps bit for bit") {
    const GraphDisk a = graph_disk(10, 0.2, 1, flat), b = graph_disk(12, 0.2, 2, flat);
    const AlignedMaps aligned =
        align_features({a.mesh, a.mesh.F, a.loop, a.rays}, {b.mesh, b.mesh.F, b.loop, b.rays});
    CHECK(aligned.rays_a == a.rays);
    CHECK(aligned.rays_b == b.rays);
    CHECK(aligned.warps == 0);
    CHECK(aligned.matches.empty());
}
