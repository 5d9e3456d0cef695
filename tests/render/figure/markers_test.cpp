#include "render/figure/markers.h"

#include <set>

#include "tests/catch.h"

using namespace automorph;

TEST_CASE("spread markers lie as far from one another as can be, each on a place of its own") {
    Points V(7, 3);
    V << 0, 0, 0, 10, 0, 0, 0, 10, 0, 10, 10, 0, 0.1, 0, 0, 10, 0, 0, 5, 5, 0;
    const std::vector<int> four = farthest_vertices(V, 4);
    const std::set<int> corners(four.begin(), four.end());
    REQUIRE(corners.size() == 4);
    // The four corners of the square, none of them twice and not the places near them.
    CHECK(corners.count(2) == 1);
    CHECK(corners.count(3) == 1);
    CHECK(corners.count(0) + corners.count(4) == 1);
    CHECK(corners.count(1) + corners.count(5) == 1);
    CHECK(farthest_vertices(V, 5).back() == 6);
    CHECK(farthest_vertices(V, 100).size() == 6);  // two vertices share a place
}

TEST_CASE("marked vertices are found in the merged mesh by their places") {
    Points source(3, 3), merged(5, 3);
    source << 0, 0, 0, 1, 0, 0, 0, 2, 0;
    merged << 0, 2, 0, 0.5, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0;
    MarkersConfig config;
    CHECK(marked_vertices(config, source, merged, {}).empty());
    config.kind = MarkersConfig::Kind::Features;
    FeatureReport report;
    report.matches = {{1, 7, 0.0}, {2, 8, 0.0}};
    CHECK(marked_vertices(config, source, merged, {report}) == std::vector<int>{2, 0});
    config.kind = MarkersConfig::Kind::Spread;
    config.count = 3;
    const std::vector<int> all = marked_vertices(config, source, merged, {});
    CHECK(std::set<int>(all.begin(), all.end()) == std::set<int>{0, 2, 4});
}

TEST_CASE("markers go with the surface") {
    render::Scene scene;
    Points V(2, 3);
    V << 1, 0, 0, 0, 5, 0;
    Markers markers(scene, {1, 0}, 0.5);
    REQUIRE(scene.mesh_count() == 1);
    const int half = scene.mesh(0).vertex_count() / 2;
    const auto center = [&](int sphere) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int v = sphere * half; v < (sphere + 1) * half; ++v)
            sum +=
                Eigen::Map<const Eigen::Vector3f>(scene.mesh(0).positions(0) + 3 * v).cast<double>() / half;
        return sum;
    };
    markers.move(scene, {V});
    CHECK((center(0) - Eigen::Vector3d(0, 5, 0)).norm() < 1e-5);
    CHECK((center(1) - Eigen::Vector3d(1, 0, 0)).norm() < 1e-5);
    markers.move(scene, {2 * V});
    CHECK((center(0) - Eigen::Vector3d(0, 10, 0)).norm() < 1e-5);
    Markers none(scene, {}, 0.5);
    none.move(scene, {V});
    CHECK(scene.mesh_count() == 1);
}
