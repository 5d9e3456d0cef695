#include "morph/alignment/border_places.h"

#include <cmath>
#include <numbers>

#include "morph/alignment/border_pull.h"
#include "morph/shapes/random.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

Points circle(int n, double shift = 0.0, double noise = 0.0) {
    Random random(static_cast<std::uint64_t>(n));
    Points points(n, 3);
    for (int k = 0; k < n; ++k) {
        const double angle = kTurn * (k + shift) / n + noise * (2 * random.uniform() - 1);
        points.row(k) << std::cos(angle), std::sin(angle), 0.1 * std::sin(3 * angle);
    }
    return points;
}

}  // namespace

TEST_CASE("a loop on its own partner keeps its places") {
    const Points loop = circle(50);
    const auto angles = monotone_angles(loop, loop);
    REQUIRE(angles);
    const Eigen::VectorXd own = arc_length_angles(loop, 0);
    for (int k = 0; k < 50; ++k) CHECK(std::abs(std::remainder((*angles)[k] - own[k], kTurn)) < 1e-9);
}

TEST_CASE("angles ascend once around, however the loop stutters") {
    const Points target = circle(40);
    const auto angles = monotone_angles(circle(300, 17.3, 0.2), target);
    REQUIRE(angles);
    for (int k = 0; k + 1 < angles->size(); ++k) REQUIRE((*angles)[k] < (*angles)[k + 1]);
    CHECK((*angles)[299] - (*angles)[0] < kTurn);
}

TEST_CASE("a loop that runs the other way, or beside its partner, has no places") {
    const Points target = circle(40);
    Points backwards = circle(60).colwise().reverse();
    CHECK_FALSE(monotone_angles(backwards, target));
    Points beside = 0.1 * circle(60);
    beside.col(0).array() += 3.0;
    CHECK_FALSE(monotone_angles(beside, target));
    CHECK_FALSE(aligned_border(backwards, target));
}

TEST_CASE("the common border holds every vertex of both loops at its place") {
    const Points source = circle(31, 0.37), target = circle(44);
    const auto border = aligned_border(source, target);
    REQUIRE(border);
    int of_source = 0, of_target = 0;
    for (int k = 0; k < border->size(); ++k) {
        of_source += border->source[static_cast<std::size_t>(k)].is_vertex();
        of_target += border->target[static_cast<std::size_t>(k)].is_vertex();
        const Eigen::Vector3d gap = position(source, border->source[static_cast<std::size_t>(k)]) -
                                    position(target, border->target[static_cast<std::size_t>(k)]);
        CHECK(gap.norm() < 0.02);
        if (k > 0) CHECK(border->angles[k] > border->angles[k - 1]);
    }
    CHECK(of_source == 31);
    CHECK(of_target == 44);
    CHECK(border->angles[0] == 0.0);
    CHECK(border->angles[border->size() - 1] < kTurn);
}

TEST_CASE("a place on a loop is the point at its angle") {
    const Points loop = circle(12);
    std::vector<int> vertices(12);
    for (int k = 0; k < 12; ++k) vertices[static_cast<std::size_t>(k)] = k;
    const Eigen::VectorXd angles = arc_length_angles(loop, 0);
    for (int k = 0; k < 12; ++k) {
        CHECK((place_on_loop(vertices, angles, angles[k] + 3 * kTurn).in(loop)-loop.row(k)).norm() < 1e-9);
    }
    const double amid = 0.5 * (angles[11] + kTurn);
    CHECK((place_on_loop(vertices, angles, amid).in(loop)-0.5 * (loop.row(11) + loop.row(0))).norm() < 1e-9);
}

TEST_CASE("openings are paired with the nearest, the border with the border") {
    // Loop 0 is the border; 1 and 2 lie at x = -1 and x = 1, in the other order in the target.
    Points source(9, 3), target(12, 3);
    source << 0, 9, 0, 9, -9, 0, -9, -9, 0, -1, 0, 0, -1, 1, 0, -1, 0, 1, 1, 0, 0, 1, 1, 0, 1, 0, 1;
    target << 0, 8, 0, 8, -8, 0, -8, -8, 0, 1.1, 0, 0, 1.1, 1, 0, 1.1, 0, 1, -1.1, 0, 0, -1.1, 1, 0, -1.1, 0,
        1, 5, 5, 5, 5, 6, 5, 5, 5, 6;
    const auto pairs = paired_loops(source, {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}, target,
                                    {{0, 1, 2}, {3, 4, 5}, {6, 7, 8}, {9, 10, 11}});
    REQUIRE(pairs.size() == 3);
    CHECK((pairs[0].source == 0 && pairs[0].target == 0));
    for (const LoopPair pair : pairs) {
        if (pair.source == 1) CHECK(pair.target == 2);
        if (pair.source == 2) CHECK(pair.target == 1);
    }
}
