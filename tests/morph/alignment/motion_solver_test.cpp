#include "morph/alignment/motion_solver.h"

#include <Eigen/Dense>
#include <cstdint>

#include "morph/alignment/prior.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/shapes/random.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

namespace {

/// Random pulls, each trusted alike in all directions, but not all alike.
Pulls isotropic_pulls(int n, std::uint64_t seed) {
    Random random(seed);
    Pulls pulls{Points(n, 3), {}};
    for (int i = 0; i < n; ++i) {
        pulls.pull.row(i) = random.in_ball<3>();
        pulls.trust.push_back((1.0 + 0.1 * (i % 7)) * Eigen::Matrix3d::Identity());
    }
    return pulls;
}

}  // namespace

TEST_CASE("the solution is that of the dense system") {
    const Mesh mesh = disks::dome(6, 0.4);
    const int n = mesh.vertex_count();
    const MotionPrior prior = motion_prior(mesh, boundary_loops(mesh, connectivity(mesh.F, n)));
    const Eigen::SparseMatrix<double> S = prior.membrane + 0.1 * prior.bending + prior.border;
    Random random(4);
    Pulls pulls{Points(n, 3), {}};
    for (int i = 0; i < n; ++i) {
        pulls.pull.row(i) = random.in_ball<3>();
        Eigen::Matrix3d half;
        for (int k = 0; k < 3; ++k) half.row(k) = random.in_ball<3>();
        pulls.trust.push_back(i % 5 == 0 ? Eigen::Matrix3d::Zero().eval() : (half * half.transpose()).eval());
    }
    MotionSolver solver(S);
    for (const double omega : {1.0, 0.01}) {
        // Unknowns ordered vertex by vertex.
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * n, 3 * n);
        Eigen::VectorXd b(3 * n);
        for (int i = 0; i < n; ++i) {
            const Eigen::Matrix3d& Q = pulls.trust[static_cast<std::size_t>(i)];
            for (int j = 0; j < n; ++j)
                A.block<3, 3>(3 * i, 3 * j) = omega * S.coeff(i, j) * Eigen::Matrix3d::Identity();
            A.block<3, 3>(3 * i, 3 * i) += Q;
            b.segment<3>(3 * i) = Q * pulls.pull.row(i).transpose();
        }
        const Eigen::VectorXd exact = A.ldlt().solve(b);
        const Points found = solver.solve(pulls, omega, Points::Zero(n, 3));
        const double difference = (found.reshaped<Eigen::RowMajor>() - exact).norm();
        CHECK(difference < 0.02 * exact.norm());  // solved to a residual of 1e-3
        // From its own answer on it stays there.
        CHECK((solver.solve(pulls, omega, found) - found).norm() < 1e-9 + 0.01 * exact.norm());
    }
    CHECK(solver.factorisations() >= 2);
}

TEST_CASE("where all trust is isotropic the factorised system is the whole one") {
    const Mesh mesh = disks::dome(6, 0.4);
    const int n = mesh.vertex_count();
    const MotionPrior prior = motion_prior(mesh, boundary_loops(mesh, connectivity(mesh.F, n)));
    const Pulls pulls = isotropic_pulls(n, 5);
    MotionSolver solver(prior.membrane + prior.bending);
    solver.solve(pulls, 0.3, Points::Zero(n, 3));
    CHECK(solver.iterations() == 1);
}

TEST_CASE("a prior beside which the pulls are lost in rounding is refused, a stiff one is not") {
    const Mesh mesh = disks::dome(6, 0.4);
    const int n = mesh.vertex_count();
    const MotionPrior prior = motion_prior(mesh, boundary_loops(mesh, connectivity(mesh.F, n)));
    Pulls pulls = isotropic_pulls(n, 6);
    pulls.pull = (0.1 * pulls.pull).rowwise() + Eigen::RowVector3d(1.0, 2.0, 3.0);
    MotionSolver solver(prior.membrane);
    // The stiffer, the nearer to one shift for all: the mean of the pulls by their trust.
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    double total = 0.0;
    for (int i = 0; i < n; ++i) {
        const double trust = pulls.trust[static_cast<std::size_t>(i)](0, 0);
        mean += trust * pulls.pull.row(i);
        total += trust;
    }
    mean /= total;
    const Points stiff = solver.solve(pulls, 1e6, Points::Zero(n, 3));
    CHECK((stiff.rowwise() - mean).rowwise().norm().maxCoeff() < 0.02 * mean.norm());
    for (const double omega : {1e18, 1e30}) {
        CHECK_THROWS_AS(solver.solve(pulls, omega, Points::Zero(n, 3)), SolverFailure);
    }
}
