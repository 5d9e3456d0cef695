#include "morph/interpolation/interpolation.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <random>

#include "tests/catch.h"

using namespace automorph;

namespace {

constexpr double kPi = 3.14159265358979323846;
const Interpolation kSchemes[] = {Interpolation::Linear, Interpolation::RigidLinear, Interpolation::Slerp};

Points random_points(int count, unsigned seed) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Points V(count, 3);
    for (Eigen::Index i = 0; i < V.size(); ++i) V.data()[i] = uniform(generator);
    return V;
}

Eigen::Vector3d mean(const Points& V) {
    return V.colwise().mean().transpose();
}

/// A shape and its copy turned by `angle` about `axis` and shifted.
Endpoints turned_copy(double angle, const Eigen::Vector3d& axis) {
    Endpoints ends;
    ends.a = random_points(50, 7).rowwise() + Eigen::RowVector3d(3, -2, 1);
    ends.R = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    ends.centre_a = mean(ends.a);
    ends.b = ((ends.a.rowwise() - ends.centre_a.transpose()) * ends.R.transpose()).rowwise() +
             Eigen::RowVector3d(-5, 4, 20);
    ends.centre_b = mean(ends.b);
    return ends;
}

/// Largest relative change of a distance between two vertices.
double distortion(const Points& V, const Points& reference) {
    double worst = 0.0;
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        for (Eigen::Index j = 0; j < i; ++j) {
            const double before = (reference.row(i) - reference.row(j)).norm();
            worst = std::max(worst, std::abs((V.row(i) - V.row(j)).norm() - before) / before);
        }
    }
    return worst;
}

bool same_bits(const Points& x, const Points& y) {
    return x.rows() == y.rows() &&
           std::memcmp(x.data(), y.data(), static_cast<std::size_t>(x.size()) * sizeof(double)) == 0;
}

}  // namespace

TEST_CASE("Both ends are the input shapes bit for bit") {
    Endpoints ends = turned_copy(2.0, {1, 2, 3});
    ends.b += 0.1 * random_points(50, 8);
    ends.a(0, 0) = -0.0;  // a sum with a zero would lose the sign
    ends.b(0, 1) = -0.0;
    for (const Interpolation scheme : kSchemes) {
        CHECK(same_bits(interpolate(ends, 0.0, scheme), ends.a));
        CHECK(same_bits(interpolate(ends, 1.0, scheme), ends.b));
    }
}

TEST_CASE("The ends are approached continuously") {
    Endpoints ends = turned_copy(2.5, {1, -2, 3});
    ends.b += 0.1 * random_points(50, 8);
    for (const Interpolation scheme : kSchemes) {
        const double speed_limit = 100.0;  // the shift is about 25 units, the turn 2.5 radians of radius 2
        CHECK((interpolate(ends, 1e-9, scheme) - ends.a).rowwise().norm().maxCoeff() < speed_limit * 1e-9);
        CHECK((interpolate(ends, 1 - 1e-9, scheme) - ends.b).rowwise().norm().maxCoeff() <
              speed_limit * 1e-9);
    }
}

TEST_CASE("Slerp frames of a rotated copy are rigid copies") {
    for (const double angle : {1e-9, 0.3, 1.0, 2.0, 3.0, kPi - 1e-6, kPi - 1e-9, kPi}) {
        const Endpoints ends = turned_copy(angle, {1, -2, 0.5});
        for (const double alpha : {0.1, 0.25, 0.5, 0.75, 0.9}) {
            CAPTURE(angle, alpha);
            CHECK(distortion(interpolate(ends, alpha, Interpolation::Slerp), ends.a) < 1e-9);
        }
    }
}

TEST_CASE("Matrices interpolated linearly shrink the shape across the axis by the closed form") {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 0.5).normalized();
    for (const double angle : {0.3, 1.0, 2.0, 3.0, kPi}) {
        const Endpoints ends = turned_copy(angle, axis);
        for (const double alpha : {0.25, 0.5, 0.75}) {
            const double expected = std::hypot(1 - alpha + alpha * std::cos(angle),
                                               alpha * std::sin(angle));  // |(1-al) + al e^(i th)|
            if (alpha == 0.5) {
                CHECK(expected == Approx(std::cos(angle / 2)).margin(1e-15));
            }
            for (const Interpolation scheme : {Interpolation::Linear, Interpolation::RigidLinear}) {
                const Points V = interpolate(ends, alpha, scheme);
                const Eigen::Vector3d centre = mean(V);
                for (int i = 0; i < V.rows(); ++i) {
                    const Eigen::Vector3d before = ends.a.row(i).transpose() - ends.centre_a;
                    const Eigen::Vector3d after = V.row(i).transpose() - centre;
                    CHECK(after.dot(axis) == Approx(before.dot(axis)).margin(1e-12));
                    CHECK(after.cross(axis).norm() ==
                          Approx(expected * before.cross(axis).norm()).margin(1e-12));
                }
            }
        }
    }
}

TEST_CASE("Centres of mass move on a straight line at constant speed") {
    Endpoints ends = turned_copy(2.2, {0, 1, 3});
    ends.b += 0.3 * random_points(50, 9);
    ends.centre_b = mean(ends.b);
    for (const Interpolation scheme : kSchemes) {
        for (const double alpha : {0.2, 0.5, 0.7}) {
            const Eigen::Vector3d expected = (1 - alpha) * ends.centre_a + alpha * ends.centre_b;
            CHECK((mean(interpolate(ends, alpha, scheme)) - expected).norm() < 1e-12);
        }
    }
}

TEST_CASE("Without a rotation all schemes are the linear one") {
    Endpoints ends;
    ends.a = random_points(40, 1);
    ends.b = random_points(40, 2);
    ends.centre_a = mean(ends.a);
    ends.centre_b = mean(ends.b);
    for (const double alpha : {0.1, 0.5, 0.8}) {
        const Points linear = (1 - alpha) * ends.a + alpha * ends.b;
        for (const Interpolation scheme : kSchemes) {
            CHECK((interpolate(ends, alpha, scheme) - linear).cwiseAbs().maxCoeff() < 1e-14);
        }
    }
}

TEST_CASE("The slerp of a rotation is the turn about its axis by the share of its angle") {
    std::mt19937 generator(3);
    std::normal_distribution<double> normal;
    for (int k = 0; k < 200; ++k) {
        const Eigen::Vector3d axis =
            Eigen::Vector3d(normal(generator), normal(generator), normal(generator)).normalized();
        for (const double angle : {1e-12, 1e-8, 1e-4, 0.5, 2.0, 3.1, kPi - 1e-5, kPi - 1e-8}) {
            const Eigen::Matrix3d R = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
            const Eigen::Matrix3d expected = Eigen::AngleAxisd(0.3 * angle, axis).toRotationMatrix();
            CHECK((slerp(R, 0.3) - expected).norm() < 1e-14);
        }
    }
}

TEST_CASE("A half turn about any axis has a half way that is a quarter turn") {
    for (const Eigen::Vector3d& direction :
         {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, 0, 1),
          Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-1, 2, 0), Eigen::Vector3d(1e-9, -1, 1e-9)}) {
        const Eigen::Vector3d u = direction.normalized();
        const Eigen::Matrix3d R = 2.0 * u * u.transpose() - Eigen::Matrix3d::Identity();
        const Eigen::Matrix3d half = slerp(R, 0.5);
        CHECK((half * half - R).norm() < 1e-14);
        CHECK(half.trace() == Approx(1.0).margin(1e-14));  // 1 + 2 cos(pi / 2)
        CHECK((half * u - u).norm() < 1e-14);
        CHECK(half.determinant() == Approx(1.0).margin(1e-14));
    }
}

TEST_CASE("The deformation is interpolated in the turned frame") {
    // Twice the size and a quarter turn about z: half way the shape is 1.5 times as large and has an eighth
    // turn.
    Endpoints ends;
    ends.a = random_points(20, 5);
    ends.R = Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    ends.b = 2.0 * ends.a * ends.R.transpose();
    const Points expected =
        1.5 * ends.a * Eigen::AngleAxisd(kPi / 4, Eigen::Vector3d::UnitZ()).toRotationMatrix().transpose();
    CHECK((interpolate(ends, 0.5, Interpolation::Slerp) - expected).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("what shading lacks moves with the shape: the ends bit for bit, in between turned alone") {
    Endpoints ends = turned_copy(2.2, {0, 1, 3});
    CHECK(interpolate_shading(ends, 0.5, Interpolation::Slerp).rows() == 0);
    ends.shading_a = random_points(50, 3);
    ends.shading_b = ends.shading_a * ends.R.transpose();
    CHECK(same_bits(interpolate_shading(ends, 0.0, Interpolation::Slerp), ends.shading_a));
    CHECK(same_bits(interpolate_shading(ends, 1.0, Interpolation::Slerp), ends.shading_b));
    const Points half = interpolate_shading(ends, 0.5, Interpolation::Slerp),
                 expected = ends.shading_a * slerp(ends.R, 0.5).transpose();
    CHECK((half - expected).norm() < 1e-12 * expected.norm());
}
