#include "morph/alignment/prior.h"

#include <Eigen/Eigenvalues>

#include "morph/mesh/connectivity.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

namespace {

struct Flat {
    Mesh mesh;
    std::vector<std::vector<int>> loops;
    MotionPrior prior;
    explicit Flat(int rings, double jitter = 0.2)
        : mesh(disks::flat(rings, jitter)),
          loops(boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count()))),
          prior(motion_prior(mesh, loops)) {}
};

double energy(const Eigen::SparseMatrix<double>& A, const Eigen::VectorXd& u) {
    return u.dot(A * u);
}

}  // namespace

TEST_CASE("a translation costs nothing") {
    const Flat flat(8);
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(flat.mesh.vertex_count());
    CHECK((flat.prior.membrane * one).cwiseAbs().maxCoeff() < 1e-12);
    CHECK((flat.prior.bending * one).cwiseAbs().maxCoeff() < 1e-9);
    CHECK((flat.prior.border * one).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("the membrane's energy of a linear function is its squared slope times the area") {
    const Flat flat(12, 0.0);  // no negative weights
    const Eigen::VectorXd u = 3.0 * flat.mesh.V.col(0) - 2.0 * flat.mesh.V.col(1);
    const double area = 0.5 * 72 * std::sin(2 * std::numbers::pi / 72);  // of the regular polygon
    CHECK(energy(flat.prior.membrane, u) == Approx(13.0 * area).epsilon(1e-9));
}

TEST_CASE("linear functions do not bend, and a parabola's bending approaches its integral") {
    double previous = 1.0;
    for (const int rings : {8, 16, 32}) {
        const Flat flat(rings, 0.0);
        const Eigen::VectorXd linear = flat.mesh.V.col(0), parabola = flat.mesh.V.rowwise().squaredNorm();
        CHECK(energy(flat.prior.bending, linear) < 1e-18 + 1e-12 * energy(flat.prior.bending, parabola));
        // The Laplacian of x^2 + y^2 is 4: the integral of its square over the unit disk is 16 pi.
        const double error = std::abs(energy(flat.prior.bending, parabola) / (16.0 * std::numbers::pi) - 1.0);
        CHECK(error < previous);
        previous = error;
    }
    CHECK(previous < 0.1);
}

TEST_CASE("the border's energy is that of the function along it") {
    const Flat flat(20);
    // sin of the angle along the unit circle: the integral of cos^2 is pi.
    CHECK(energy(flat.prior.border, flat.mesh.V.col(1)) == Approx(std::numbers::pi).epsilon(2e-3));
}

TEST_CASE("slivers and triangles without area leave the priors positive and finite") {
    Mesh mesh = disks::flat(6, 0.0);
    mesh.V.row(1) = mesh.V.row(2);                           // an edge of no length
    mesh.V.row(9) = 0.5 * (mesh.V.row(8) + mesh.V.row(10));  // and something thin
    const MotionPrior prior =
        motion_prior(mesh, boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count())));
    for (const auto* A : {&prior.membrane, &prior.bending, &prior.border}) {
        const Eigen::MatrixXd dense(*A);
        REQUIRE(dense.allFinite());
        const Eigen::VectorXd eigenvalues =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
        CHECK(eigenvalues.minCoeff() > -1e-9 * eigenvalues.maxCoeff());
    }
}

TEST_CASE("the tip of a fan does not tie all of its neighbours to one another") {
    const int n = 3000;
    Mesh fan{Points(n + 1, 3), Triangles(n, 3)};
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        fan.V.row(i) << std::cos(angle), std::sin(angle), 0.0;
        fan.F.row(i) << i, (i + 1) % n, n;
    }
    fan.V.row(n) << 0.0, 0.0, 1.0;
    const MotionPrior prior = motion_prior(fan, {});
    CHECK(prior.bending.nonZeros() < 20 * n);  // n^2 if it did
    CHECK((prior.bending * Eigen::VectorXd::Ones(n + 1)).cwiseAbs().maxCoeff() <
          1e-9 * prior.bending.coeffs().cwiseAbs().maxCoeff());
}
