#include "render/camera/framing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>

#include "morph/mesh/errors.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::render;

namespace {

constexpr int kWidth = 300, kHeight = 200;

Points random_cloud(std::mt19937& random, double scale) {
    std::normal_distribution<double> normal;
    Points V(200, 3);
    for (double& x : V.reshaped()) x = normal(random);
    V.col(0) *= scale;
    V.rowwise() += Eigen::RowVector3d(normal(random), normal(random), normal(random)) * 10.0;
    return V;
}

// Smallest distance, in fractions of the half picture, of a projected point from each side: left, right, top,
// bottom.
Eigen::Array4d borders(const Camera& camera, const std::vector<Points>& frames) {
    const PictureCamera pinhole(camera, kWidth, kHeight);
    Eigen::Array4d result = Eigen::Array4d::Constant(1e9);
    for (const Points& V : frames) {
        for (int i = 0; i < V.rows(); ++i) {
            const Eigen::Vector2d p = pinhole.project(V.row(i).transpose()).value();
            const double x = 2.0 * p.x() / kWidth, y = 2.0 * p.y() / kHeight;
            result = result.min(Eigen::Array4d(x, 2.0 - x, y, 2.0 - y));
        }
    }
    return result;
}

}  // namespace

TEST_CASE("the framed camera shows all points of all frames and touches the margin on two opposite sides") {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int trial = 0; trial < 100; ++trial) {
        const std::vector<Points> frames{random_cloud(random, 1.0), random_cloud(random, trial % 7)};
        FramingOptions options;
        options.direction = {normal(random), normal(random), normal(random)};
        options.vertical_fov = 5.0 + 0.6 * trial;
        options.aspect = static_cast<double>(kWidth) / kHeight;
        options.margin = 0.01 * (trial % 20);
        const Camera camera = frame_all(frames, options);
        CHECK((camera.target - camera.position).normalized().dot(options.direction.normalized()) ==
              Approx(1.0).margin(1e-12));
        const Eigen::Array4d free = borders(camera, frames);
        CHECK(free.minCoeff() > options.margin - 1e-9);
        const double sides = std::max(free[0], free[1]), ends = std::max(free[2], free[3]);
        CHECK(std::min(sides, ends) == Approx(options.margin).margin(1e-9));
    }
}

TEST_CASE("a square seen head on is framed at the distance of the closed form") {
    Points V(4, 3);
    V << -1, 5, -1, 1, 5, -1, 1, 5, 1, -1, 5, 1;
    FramingOptions options;
    options.direction = {0.0, 2.0, 0.0};
    options.vertical_fov = 90.0;
    options.margin = 0.2;
    options.aspect = 1.5;
    const Camera camera = frame_all({V}, options);
    CHECK((camera.position - Eigen::Vector3d(0, 5 - 1 / 0.8, 0)).norm() < 1e-12);
    options.aspect = 0.5;
    CHECK((frame_all({V}, options).position - Eigen::Vector3d(0, 5 - 2 / 0.8, 0)).norm() < 1e-12);
}

TEST_CASE("a point at the tip of the view's cone stays in front of the camera") {
    Points V(3, 3);
    V << 0, 0, 0, 0.1, 2, 0, -0.1, 1, 0.1;
    FramingOptions options;
    options.direction = {0.0, 1.0, 0.0};
    options.vertical_fov = 100.0;
    const Camera camera = frame_all({V}, options);
    CHECK((camera.position - Eigen::Vector3d(0.0, -0.02, 0.0)).norm() < 0.05);
    CHECK(camera.position.y() == Approx(-0.02));
    CHECK(borders(camera, {V}).minCoeff() > options.margin);
}

TEST_CASE("frames may be added one by one, and rows that are not finite do not count") {
    std::mt19937 random(2);
    const Points a = random_cloud(random, 1.0), b = random_cloud(random, 3.0);
    Points broken = b;
    broken.conservativeResize(b.rows() + 2, 3);
    broken.bottomRows(2).setConstant(std::nan(""));
    broken(b.rows(), 0) = INFINITY;
    Framing framing({});
    framing.add(a);
    framing.add(broken);
    CHECK(framing.camera().position == frame_all({a, b}).position);
}

TEST_CASE("a single point, and points on one view ray, give a valid camera") {
    Points V = Points::Constant(1, 3, 4.0);
    for (double second : {4.0, 6.0}) {
        V.conservativeResize(2, 3);
        V.row(1).setConstant(second);
        FramingOptions options;
        options.direction = {1.0, 1.0, 1.0};
        const Camera camera = frame_all({V}, options);
        const PictureCamera pinhole(camera, kWidth, kHeight);
        for (int i = 0; i < 2; ++i) {
            const Eigen::Vector2d p = pinhole.project(V.row(i).transpose()).value();
            CHECK((p - Eigen::Vector2d(0.5 * kWidth, 0.5 * kHeight)).norm() < 1e-6);
        }
    }
}

TEST_CASE("what floats cannot show is refused") {
    std::mt19937 random(4);
    const Points V = random_cloud(random, 1.0);
    CHECK_NOTHROW(frame_all({1e-10 * V}));
    CHECK_THROWS_AS(frame_all({1e-13 * V}), Error);
    CHECK_NOTHROW(frame_all({1e6 * V}));
    CHECK_THROWS_AS(frame_all({1e8 * V}), Error);
}

TEST_CASE("framing refuses nothing to frame and options out of range") {
    CHECK_THROWS_AS(Framing({}).camera(), Error);
    FramingOptions options;
    SECTION("margin") {
        options.margin = 1.0;
    }
    SECTION("aspect") {
        options.aspect = 0.0;
    }
    SECTION("field of view") {
        options.vertical_fov = -1.0;
    }
    SECTION("direction along up") {
        options.direction = options.up;
    }
    CHECK_THROWS_AS(Framing(options), ConfigError);
}

namespace {

Points swept(const Points& V, const Sweep& sweep, int steps) {
    Points all(V.rows() * (steps + 1), 3);
    for (int i = 0; i <= steps; ++i) {
        const double degrees = sweep.from + (sweep.to - sweep.from) * i / steps;
        const Eigen::Matrix3d R =
            Eigen::AngleAxisd(degrees * std::acos(-1.0) / 180, sweep.axis.normalized()).toRotationMatrix();
        all.middleRows(i * V.rows(), V.rows()) =
            ((V.rowwise() - sweep.point.transpose()) * R.transpose()).rowwise() + sweep.point.transpose();
    }
    return all;
}

}  // namespace

TEST_CASE("the camera of a turn is that of all places passed, at angles between frames, too") {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    constexpr int kSteps = 2000;
    for (int trial = 0; trial < 30; ++trial) {
        const Points V = random_cloud(random, 1.0).topRows(20);
        Sweep sweep;
        sweep.point = {normal(random), normal(random), normal(random)};
        sweep.axis = {normal(random), normal(random), normal(random)};
        sweep.from = 200 * normal(random);
        sweep.to = sweep.from + (trial % 3 == 0 ? 360.0 : 120 * normal(random));
        FramingOptions options;
        options.direction = {normal(random), normal(random), normal(random)};
        options.aspect = static_cast<double>(kWidth) / kHeight;
        Framing exact(options), dense(options);
        exact.add(V, sweep);
        dense.add(swept(V, sweep, kSteps));
        const Camera camera = exact.camera(), sampled = dense.camera();
        const double size = (camera.position - camera.target).norm();
        // Samples miss the extremes by the square of half a step.
        CHECK((camera.position - sampled.position).norm() < 1e-4 * size);
        CHECK(borders(camera, {swept(V, sweep, kSteps)}).minCoeff() > options.margin - 1e-9);
    }
}

TEST_CASE("a turn by nothing is no turn, and its sense does not matter to the camera") {
    std::mt19937 random(3);
    const Points V = random_cloud(random, 1.0);
    Framing still(FramingOptions{}), turned(FramingOptions{}), there(FramingOptions{}),
        back(FramingOptions{});
    still.add(V);
    turned.add(V, {{1, 2, 3}, {0, 0, 1}, 0, 0});
    CHECK((still.camera().position - turned.camera().position).norm() < 1e-9);
    there.add(V, {{1, 2, 3}, {0, 0, 1}, -30, 70});
    back.add(V, {{1, 2, 3}, {0, 0, 1}, 70, -30});
    CHECK((there.camera().position - back.camera().position).norm() < 1e-9);
}
