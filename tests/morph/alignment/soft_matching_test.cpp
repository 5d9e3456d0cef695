#include "morph/alignment/soft_matching.h"

#include <tbb/task_arena.h>

#include "morph/mesh/geometry.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

constexpr SoftMatching::Scales kFine{0.02, 0.3};

OrientedPoints shape(std::uint64_t seed) {
    return oriented_points(star({}, {.triangles = 3000, .seed = seed}));
}

}  // namespace

TEST_CASE("another tessellation of the same surface draws every point to its own place") {
    const OrientedPoints source = shape(1), target = shape(2);
    const SoftMatches matches = SoftMatching(target).match(source, kFine);
    const double size = bounding_box_diagonal(source.points);
    CHECK((matches.centre - source.points).rowwise().norm().maxCoeff() < 0.03 * size);
    CHECK(matches.weight.minCoeff() > 0.2 * source.weight.minCoeff());
}

TEST_CASE("a point without a partner goes free") {
    OrientedPoints source = shape(1);
    source.points.row(7) *= 3.0;  // far off
    const SoftMatches matches = SoftMatching(shape(2)).match(source, kFine);
    CHECK(matches.weight[7] < 1e-6 * matches.weight.mean());
    CHECK(matches.centre.allFinite());
}

TEST_CASE("opposite normals do not match") {
    const OrientedPoints target = shape(2);
    OrientedPoints source = shape(1);
    source.normals.row(11) *= -1.0;
    const SoftMatches matches = SoftMatching(target).match(source, kFine);
    CHECK(matches.weight[11] < 0.03 * matches.weight.mean());
}

TEST_CASE("trust is firm across a flat place and loose along it, and firm all around at a tip") {
    const Mesh mesh = ellipsoid({1.0, 1.0, 0.05}, {.triangles = 6000});
    const OrientedPoints points = oriented_points(mesh);
    const SoftMatches matches = SoftMatching(points).match(points, kFine);
    Eigen::Index flat = 0;
    (points.points.leftCols<2>().rowwise().norm()).minCoeff(&flat);
    const Eigen::Matrix3d& Q = matches.trust[static_cast<std::size_t>(flat)];
    CHECK(Q(2, 2) > 3.0 * Q(0, 0));
    CHECK(Q(2, 2) > 3.0 * Q(1, 1));
}

TEST_CASE("matches are the same bits with one thread") {
    const OrientedPoints source = shape(1);
    const SoftMatching matching(shape(2));
    const SoftMatches many = matching.match(source, kFine);
    tbb::task_arena one(1);
    const SoftMatches single = one.execute([&] { return matching.match(source, kFine); });
    CHECK(many.centre == single.centre);
    CHECK(many.weight == single.weight);
}
