#include "morph/registration/procrustes.h"

#include <Eigen/LU>
#include <vector>

#include "tests/catch.h"
#include "tests/morph/registration/shapes.h"

using namespace automorph;

namespace {

double cost(const Points& source, const Points& target, const Eigen::VectorXd& weights,
            const RigidMotion& motion) {
    return weights.dot((motion.apply(source) - target).rowwise().squaredNorm());
}

}  // namespace

TEST_CASE("weighted Procrustes recovers a known motion") {
    test::Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const Points source = test::random_points(4 + trial % 30, random);
        Eigen::VectorXd weights(source.rows());
        for (int i = 0; i < weights.size(); ++i) weights[i] = 0.01 + random.uniform();
        const RigidMotion truth{random.rotation(), 3.0 * random.normal3()};
        const RigidMotion found = weighted_procrustes(source, truth.apply(source), weights);
        REQUIRE((found.R - truth.R).cwiseAbs().maxCoeff() < 1e-12);
        REQUIRE((found.t - truth.t).cwiseAbs().maxCoeff() < 1e-12);
    }
}

TEST_CASE("points of weight zero do not count") {
    test::Random random(2);
    const Points source = test::random_points(20, random);
    const RigidMotion truth{random.rotation(), random.normal3()};
    Points target = truth.apply(source);
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(20);
    for (int i = 0; i < 5; ++i) {
        target.row(i) = 100.0 * random.normal3();
        weights[i] = 0.0;
    }
    REQUIRE((weighted_procrustes(source, target, weights).R - truth.R).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE(
    "the result is a proper rotation, and the best one, also for mirrored, flat, collinear and equal "
    "points") {
    test::Random random(3);
    for (int trial = 0; trial < 400; ++trial) {
        Points source = test::random_points(10, random);
        const Eigen::Vector3d squeeze = std::vector<Eigen::Vector3d>{
            {1, 1, 1}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}}[static_cast<std::size_t>(trial % 4)];
        source = source * squeeze.asDiagonal();
        Points target = source * random.rotation().transpose();
        target.col(0) *= -1.0;  // mirrored
        target += 0.05 * test::random_points(10, random);
        const Eigen::VectorXd weights = Eigen::VectorXd::Ones(10);
        const RigidMotion found = weighted_procrustes(source, target, weights);
        REQUIRE((found.R.transpose() * found.R - Eigen::Matrix3d::Identity()).norm() < 1e-12);
        REQUIRE(found.R.determinant() == Approx(1.0).epsilon(1e-12));

        const double best = cost(source, target, weights, found);
        for (int other = 0; other < 20; ++other) {
            const double size = other % 2 == 0 ? 1.0 : 0.05;  // far and near
            const Eigen::Matrix3d turn =
                Eigen::AngleAxisd(size * random.normal(), random.normal3().normalized()).toRotationMatrix();
            const RigidMotion rival{turn * found.R, found.t + size * 0.1 * random.normal3()};
            REQUIRE(cost(source, target, weights, rival) >= best * (1.0 - 1e-12));
        }
    }
}

TEST_CASE("the angle of a rotation is accurate for small and large turns") {
    for (const double angle : {0.0, 1e-9, 1e-3, 1.0, 3.0, 3.14159}) {
        const Eigen::AngleAxisd turn(angle, Eigen::Vector3d(1, 2, -2) / 3.0);
        CHECK(rotation_angle(turn.toRotationMatrix()) == Approx(angle).epsilon(1e-6).margin(1e-15));
    }
}
