#include "morph/registration/em_icp.h"

#include <Eigen/LU>

#include "morph/mesh/errors.h"
#include "morph/registration/neighbourhoods.h"
#include "morph/registration/registration.h"
#include "morph/registration/starts.h"
#include "morph/registration/surface_sample.h"
#include "tests/catch.h"
#include "tests/morph/registration/shapes.h"

using namespace automorph;

TEST_CASE("responsibilities obey Eq. (6)") {
    test::Random random(1);
    const Points source = test::random_points(40, random), target = test::random_points(30, random);
    Registration registration;
    registration.R = random.rotation();
    registration.t = random.normal3();
    registration.scale = 1.3;
    registration.sigma = 0.4;
    const Points y = registration.apply(source);

    SECTION("against all targets when nothing is truncated") {
        const auto P = responsibilities(source, target, registration, 30);
        for (int i = 0; i < 40; ++i) {
            Eigen::VectorXd row(30);
            for (int j = 0; j < 30; ++j) {
                const double d = (y.row(i) - target.row(j)).norm();
                row[j] = std::exp(-d * d / (2.0 * 0.4 * 0.4));
            }
            row /= row.sum();
            for (int j = 0; j < 30; ++j)
                REQUIRE(P.coeff(i, j) == Approx(row[j]).epsilon(1e-9).margin(1e-300));
        }
    }
    SECTION("over the nearest ones when truncated") {
        const auto P = responsibilities(source, target, registration, 5);
        for (int i = 0; i < 40; ++i) {
            std::vector<std::pair<double, int>> near;
            for (int j = 0; j < 30; ++j) near.emplace_back((y.row(i) - target.row(j)).squaredNorm(), j);
            std::sort(near.begin(), near.end());
            double sum = 0.0;
            for (int j = 0; j < 5; ++j) sum += std::exp(-near[j].first / (2.0 * 0.4 * 0.4));
            for (int j = 0; j < 30; ++j) {
                const double expected = j < 5 ? std::exp(-near[j].first / (2.0 * 0.4 * 0.4)) / sum : 0.0;
                REQUIRE(P.coeff(i, near[j].second) == Approx(expected).epsilon(1e-9).margin(1e-300));
            }
        }
    }
    SECTION("rows sum to 1 and fall back to the nearest where the Gaussians underflow") {
        for (const double sigma : {1.0, 1e-3, 1e-160, 0.0}) {
            registration.sigma = sigma;
            const auto P = responsibilities(source, target, registration);
            REQUIRE(P.rows() == 40);
            REQUIRE(P.cols() == 30);
            for (int i = 0; i < 40; ++i) {
                double sum = 0.0;
                for (int j = 0; j < 30; ++j) sum += P.coeff(i, j);
                REQUIRE(sum == Approx(1.0).epsilon(1e-12));
                Eigen::Index nearest = 0;
                (target.rowwise() - y.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
                for (int j = 0; j < 30; ++j) REQUIRE(P.coeff(i, j) <= P.coeff(i, nearest));
                if (sigma < 1e-100) REQUIRE(P.coeff(i, nearest) == 1.0);
            }
        }
    }
    SECTION("fewer targets than neighbours are all used, and none at all is no error") {
        CHECK(responsibilities(source, target.topRows(3), registration).nonZeros() == 120);
        CHECK(responsibilities(source, Points(0, 3), registration).nonZeros() == 0);
    }
}

TEST_CASE("remembered neighbours are those that the tree would find") {
    test::Random random(2);
    const Points target = test::random_points(500, random);
    const NearestPoints<3> tree(target);
    Points points = test::random_points(100, random);
    Neighbourhoods remembering(tree, 100, 6);
    for (int step = 0; step < 30; ++step) {
        for (int i = 0; i < 100; ++i) points.row(i) += 0.03 * random.normal3();
        remembering.find(points);
        Neighbourhoods fresh(tree, 100, 6);
        fresh.find(points);
        REQUIRE(remembering.sigma() == Approx(fresh.sigma()).epsilon(1e-14));
        const Points difference = remembering.expected(target, 0.3) - fresh.expected(target, 0.3);
        REQUIRE(difference.cwiseAbs().maxCoeff() < 1e-13);
    }
}

TEST_CASE("EM-ICP brings a shape near its pose, and the polish home") {
    const Mesh mesh = test::with_bumps(test::icosphere(3), 0.4);
    test::Random random(3);
    for (int trial = 0; trial < 10; ++trial) {
        const RigidMotion truth{random.rotation(), random.normal3()};
        const NearestPoints<3> tree(truth.apply(mesh.V));
        const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1, random.normal3().normalized()).toRotationMatrix();
        const EmIcpResult result = em_icp(mesh.V, tree, {turn * truth.R, truth.t});
        REQUIRE(result.converged);
        // Eq. (5) alone may stop some degrees away on a smooth shape; the polish must not.
        REQUIRE(test::degrees(rotation_angle(result.motion.R * truth.R.transpose())) < 15.0);
        const Points normals = vertex_normals(mesh) * truth.R.transpose();
        const EmIcpResult polished = polish_along_normals(mesh.V, tree, normals, result.motion);
        REQUIRE(test::degrees(rotation_angle(polished.motion.R * truth.R.transpose())) < 0.05);
    }
}

TEST_CASE("EM-ICP says when it did not converge") {
    const Mesh mesh = test::with_bumps(test::icosphere(3), 0.4);
    const NearestPoints<3> tree(mesh.V);
    const RigidMotion start{Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()).toRotationMatrix(),
                            Eigen::Vector3d::Zero()};
    const EmIcpResult result = em_icp(mesh.V, tree, start, {.max_iterations = 2});
    CHECK_FALSE(result.converged);
    CHECK(result.iterations == 2);
}

TEST_CASE("the starting rotations are proper and no rotation is far from all of them") {
    test::Random random(4);
    const Points cloud = test::random_points(50, random);
    const auto starts = starting_rotations(cloud, cloud, 7);
    REQUIRE(starts.size() == 64);
    for (const Eigen::Matrix3d& R : starts) {
        REQUIRE((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < 1e-12);
        REQUIRE(R.determinant() == Approx(1.0));
    }
    for (int i = 0; i < 60; ++i) {
        for (int j = 0; j < i; ++j)
            REQUIRE(test::degrees(rotation_angle(starts[i] * starts[j].transpose())) > 71.9);
    }
    double farthest = 0.0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Eigen::Matrix3d R = random.rotation();
        double nearest = 180.0;
        for (int i = 0; i < 60; ++i)
            nearest = std::min(nearest, test::degrees(rotation_angle(starts[i] * R.transpose())));
        farthest = std::max(farthest, nearest);
    }
    CHECK(farthest < 44.5);
}

TEST_CASE("a surface's size is its exact root mean square radius") {
    Mesh square{Points(4, 3), Triangles(2, 3)};
    square.V << 0, 0, 5, 2, 0, 5, 2, 2, 5, 0, 2, 5;
    square.F << 0, 1, 2, 0, 2, 3;
    const SurfaceSize size = surface_size(square);
    CHECK(size.radius == Approx(std::sqrt(2.0 / 3.0)));  // variance 1/3 along either side
    CHECK((size.centre - Eigen::Vector3d(1, 1, 5)).norm() < 1e-15);
}

TEST_CASE("samples lie on the surface, evenly, and depend on the seed alone") {
    const Mesh sphere = test::icosphere(4);
    const SurfaceSample sample = sample_surface(sphere, surface_size(sphere), 2000, 5);
    REQUIRE(sample.size() == 2000);
    CHECK((sample.points.rowwise().norm().array() - 1.0).abs().maxCoeff() < 0.01);
    CHECK((sample.points - sample.normals).rowwise().norm().maxCoeff() < 0.02);
    CHECK(sample.points.colwise().mean().norm() < 0.01);
    for (const int octant : {0, 1, 2, 3, 4, 5, 6, 7}) {
        const Eigen::Vector3d signs(octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1);
        const auto inside = ((sample.points * signs.asDiagonal()).array() > 0.0).rowwise().all().count();
        CHECK(std::abs(static_cast<double>(inside) - 250.0) < 35.0);
    }
    CHECK(sample_surface(sphere, surface_size(sphere), 2000, 5).points == sample.points);
    CHECK(sample_surface(sphere, surface_size(sphere), 2000, 6).points != sample.points);
    CHECK(thin_out(sample, 100).size() == 100);
    CHECK(thin_out(sample, 100).spacing == Approx(sample.spacing * std::sqrt(20.0)));
}

TEST_CASE("closed and open meshes are told apart") {
    const Mesh sphere = test::icosphere(2);
    CHECK(is_closed(sphere));
    CHECK_FALSE(is_closed(test::cropped(sphere, Eigen::Vector3d::UnitZ(), 0.0)));
}

TEST_CASE("registration refuses what has no surface") {
    const Mesh sphere = test::icosphere(1);
    Mesh empty, flat = sphere, broken = sphere;
    flat.V.setZero();
    broken.V(7, 1) = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS(register_rigid(empty, sphere), InvalidMesh);
    CHECK_THROWS_AS(register_rigid(sphere, flat), InvalidMesh);
    CHECK_THROWS_AS(register_rigid(broken, sphere), InvalidMesh);
}
