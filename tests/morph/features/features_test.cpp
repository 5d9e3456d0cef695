#include "morph/features/features.h"

#include <algorithm>
#include <random>
#include <set>
#include <span>

#include "tests/catch.h"
#include "tests/morph/features/maps.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

/// Candidates and matches of two surfaces.
struct Features {
    std::vector<int> candidates_a, candidates_b;
    std::vector<FeatureMatch> matches;
};

/// The paper's choice: curvature as it is, matched with any vertex.
struct Paper {
    double c = -100.0, r = 0.1, m = 100.0;
    operator FeatureOptions() const {
        return {.largest_gaussian = c,
                .radius = r,
                .largest_difference = m,
                .targets = FeatureTargets::Vertices,
                .scales = {0.0}};
    }
};

Features match(const GraphDisk& a, const GraphDisk& b, const FeatureOptions& options = Paper{}) {
    const FeatureCandidates of_a = feature_candidates(a.mesh, options),
                            of_b = feature_candidates(b.mesh, options);
    return {of_a.vertices, of_b.vertices, match_features(of_a, a.rays, of_b, b.rays, options)};
}

/// Distance of a vertex from the nearest of the four saddles of the egg box.
double from_saddle(const Points& rays, int v) {
    return std::hypot(std::abs(rays(v, 0)) - 0.5, std::abs(rays(v, 1)) - 0.5);
}

bool one_to_one(const Features& features) {
    std::set<int> of_a, of_b;
    for (const FeatureMatch& m : features.matches)
        if (!of_a.insert(m.vertex_a).second || !of_b.insert(m.vertex_b).second) return false;
    return true;
}

/// Vertices in another order.
GraphDisk renumbered(const GraphDisk& disk, unsigned seed) {
    std::vector<int> order(static_cast<std::size_t>(disk.mesh.vertex_count()));
    for (std::size_t v = 0; v < order.size(); ++v) order[v] = static_cast<int>(v);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    GraphDisk result = disk;
    for (int v = 0; v < disk.mesh.vertex_count(); ++v) {
        result.mesh.V.row(order[static_cast<std::size_t>(v)]) = disk.mesh.V.row(v);
        result.rays.row(order[static_cast<std::size_t>(v)]) = disk.rays.row(v);
    }
    for (int& v : std::span(result.mesh.F.data(), static_cast<std::size_t>(result.mesh.F.size())))
        v = order[static_cast<std::size_t>(v)];
    return result;
}

}  // namespace

TEST_CASE("the candidates of an egg box are its four saddles") {
    const GraphDisk disk = graph_disk(30, 0.0, 1, egg_box);
    const Features features = match(disk, disk);
    REQUIRE(features.candidates_a.size() == 4);
    for (const int v : features.candidates_a) CHECK(from_saddle(disk.rays, v) < 1.0 / 30);
    CHECK(features.candidates_b == features.candidates_a);
    // K there is -pi^4 / 4 = -24 times the area, some 6.
    CHECK(match(disk, disk, Paper{.c = -200.0}).candidates_a.empty());
    CHECK(match(disk, disk, Paper{.c = -200.0}).matches.empty());
}

TEST_CASE("every candidate of a surface matches itself, however the vertices are numbered") {
    const GraphDisk disk = graph_disk(25, 0.2, 3, egg_box), same = renumbered(disk, 5);
    const auto targets = GENERATE(FeatureTargets::Vertices, FeatureTargets::Candidates);
    for (const std::vector<double>& scales : {std::vector{0.0}, std::vector{0.02, 0.05}}) {
        const Features features =
            match(disk, same, {.largest_gaussian = -40.0, .targets = targets, .scales = scales});
        REQUIRE(features.candidates_a.size() >= 4);
        CHECK(features.candidates_b.size() == features.candidates_a.size());
        CHECK(features.matches.size() == features.candidates_a.size());
        CHECK(one_to_one(features));
        for (const FeatureMatch& m : features.matches) {
            CHECK(disk.rays.row(m.vertex_a) == same.rays.row(m.vertex_b));
            CHECK(m.difference < 1e-6);
        }
    }
}

TEST_CASE(
    "smoothed minima are found again in another tessellation of their surface; curvature as it is finds "
    "noise") {
    const FeatureOptions smooth{.largest_gaussian = -40.0, .radius = 0.2, .scales = {0.03, 0.05}};
    double distance_by_minima = 0.0, distance_by_any_vertex = 0.0;
    int any_vertex = 0;
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
        const GraphDisk a = graph_disk(30, 0.2, seed, egg_box), b = graph_disk(37, 0.2, seed + 10, egg_box);
        const auto apart = [&](const FeatureMatch& m) {
            return (a.rays.row(m.vertex_a) - b.rays.row(m.vertex_b)).norm();
        };
        const Features features = match(a, b, smooth);
        CHECK(features.candidates_a.size() == 4);
        REQUIRE(features.matches.size() == 4);
        CHECK(one_to_one(features));
        for (const FeatureMatch& m : features.matches) {
            CHECK(from_saddle(a.rays, m.vertex_a) < 0.08);
            CHECK(apart(m) < 0.08);
            distance_by_minima += apart(m) / 16;
        }
        for (const FeatureMatch& m : match(a, b, Paper{.c = -40.0, .r = 0.2}).matches) {
            distance_by_any_vertex += apart(m);
            ++any_vertex;
        }
    }
    CHECK(distance_by_minima < 0.04);
    CHECK(distance_by_any_vertex / any_vertex > 2.0 * distance_by_minima);
}

TEST_CASE("a feature that has moved in the map is found within the radius and not beyond") {
    const auto moved = [](double shift) {
        return [shift](double x, double y) { return egg_box(x - shift, y); };
    };
    const GraphDisk a = graph_disk(40, 0.0, 1, moved(0.0)), b = graph_disk(40, 0.0, 1, moved(0.08));
    const auto off = [&](const FeatureMatch& m) {
        return (b.rays.row(m.vertex_b) - a.rays.row(m.vertex_a) - Eigen::RowVector3d(0.08, 0, 0)).norm();
    };
    const Features found = match(a, b, Paper{.r = 0.15, .m = 10.0});
    CHECK(found.matches.size() == 4);
    for (const FeatureMatch& m : found.matches) CHECK(off(m) < 0.05);
    CHECK(match(a, b, Paper{.r = 0.03, .m = 10.0}).matches.empty());
}

TEST_CASE("the search grows and shrinks with the spacing of the points in the map") {
    const auto changed = [](GraphDisk disk, double scale, double shift) {
        disk.rays.leftCols<2>() *= scale;
        disk.rays.col(0).array() += shift;
        return disk;
    };
    const auto matches = [&](double scale, double radius) {
        const GraphDisk disk = graph_disk(30, 0.0, 1, egg_box);
        const GraphDisk a = changed(disk, scale, 0.0), b = changed(disk, scale, 0.02);
        return match(a, b, Paper{.r = radius, .m = 5.0}).matches.size();
    };
    CHECK(matches(1.0, 0.1) == 4);
    CHECK(matches(0.1, 0.1) == 0);  // all of b lies within 0.1: the search is 0.01 wide
    CHECK(matches(0.1, 0.3) == 4);
}

TEST_CASE("matches are one-to-one where many candidates want the same vertex") {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> height(-0.05, 0.05);
    for (int trial = 0; trial < 10; ++trial) {
        const GraphDisk a = graph_disk(20, 0.2, 1, [&](double, double) { return height(random); });
        const GraphDisk b = graph_disk(6, 0.2, 2, [&](double, double) { return height(random); });
        const Features features = match(a, b, Paper{.r = 0.5, .m = 1e9});
        CHECK(features.matches.size() > 5);
        CHECK(features.matches.size() < features.candidates_a.size());
        CHECK(one_to_one(features));
        for (const FeatureMatch& m : features.matches)
            CHECK(std::binary_search(features.candidates_a.begin(), features.candidates_a.end(), m.vertex_a));
    }
}

TEST_CASE("borders and what is left out of the surface hold no features") {
    const GraphDisk disk = graph_disk(30, 0.0, 1, egg_box);
    Mesh without = disk.mesh;
    int kept = 0;
    for (int f = 0; f < disk.mesh.triangle_count(); ++f) {  // a hole round one saddle
        const Eigen::RowVector3d centre =
            (disk.rays.row(disk.mesh.F(f, 0)) + disk.rays.row(disk.mesh.F(f, 1)) +
             disk.rays.row(disk.mesh.F(f, 2))) /
            3;
        if ((centre - Eigen::RowVector3d(0.5, 0.5, 1)).norm() > 0.15)
            without.F.row(kept++) = disk.mesh.F.row(f);
    }
    without.F.conservativeResize(kept, 3);
    const Features features = match({without, disk.loop, disk.rays}, disk);
    CHECK(features.candidates_b.size() == 4);
    for (const int v : features.candidates_a) CHECK_FALSE((disk.rays(v, 0) > 0.45 && disk.rays(v, 1) > 0.45));
    for (const FeatureMatch& m : features.matches)
        CHECK(disk.rays.row(m.vertex_a).head<2>().norm() < 1.0 - 1e-9);
}
