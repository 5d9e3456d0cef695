#include "morph/alignment/motion_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "morph/mesh/errors.h"

namespace automorph {

namespace {

constexpr double kResidual = 3e-3;    // relative; the rounds correct each other
constexpr double kNoSolution = 0.03;  // relative residual: such an answer is none
constexpr int kMaxIterations = 60;
constexpr int kQuick = 12;            // more iterations than this: time for a new factorisation
constexpr double kLeastTrust = 1e-9;  // of the mean trust: keeps the factorisation definite

double dot(const Points& a, const Points& b) {
    return a.cwiseProduct(b).sum();
}

}  // namespace

MotionSolver::MotionSolver(Eigen::SparseMatrix<double> prior) : prior_(std::move(prior)) {
    // The diagonal belongs to the pattern, whatever the mesh.
    Eigen::SparseMatrix<double> identity(prior_.rows(), prior_.cols());
    identity.setIdentity();
    prior_ = (prior_ + 0.0 * identity).eval();
    prior_.makeCompressed();
    preconditioner_.analyzePattern(prior_);
}

void MotionSolver::factorise(const Pulls& pulls, double omega) {
    Eigen::SparseMatrix<double> A = omega * prior_;
    double mean = 0.0;
    for (const Eigen::Matrix3d& Q : pulls.trust) mean += Q.trace() / 3.0;
    mean /= static_cast<double>(pulls.trust.size());
    for (Eigen::Index i = 0; i < A.rows(); ++i)
        A.coeffRef(i, i) += pulls.trust[static_cast<std::size_t>(i)].trace() / 3.0 + kLeastTrust * mean;
    preconditioner_.factorize(A);
    if (preconditioner_.info() != Eigen::Success)
        throw SolverFailure("alignment: the smooth motion's system cannot be factorised");
    factorised_omega_ = omega;
    ++factorisations_;
}

// As SimplicialLLT::solve, but with one pass over the factor for all three coordinates: reading it is what
// takes the time.
void MotionSolver::precondition(const Points& r, Points& z) {
    const Eigen::SparseMatrix<double>& L = preconditioner_.matrixL().nestedExpression();
    const int* const start = L.outerIndexPtr();
    const int* const row = L.innerIndexPtr();
    const double* const value = L.valuePtr();
    const auto& place = preconditioner_.permutationP().indices();
    const int n = static_cast<int>(r.rows());
    permuted_.resize(n, 4);
    for (int i = 0; i < n; ++i) permuted_.row(place[i]) << r.row(i), 0.0;
    for (int j = 0; j < n; ++j) {  // the diagonal comes first in each column
        const Eigen::RowVector4d x = permuted_.row(j) /= value[start[j]];
        for (int p = start[j] + 1; p < start[j + 1]; ++p) permuted_.row(row[p]) -= value[p] * x;
    }
    for (int j = n - 1; j >= 0; --j) {
        Eigen::RowVector4d x = permuted_.row(j);
        for (int p = start[j] + 1; p < start[j + 1]; ++p) x -= value[p] * permuted_.row(row[p]);
        permuted_.row(j) = x / value[start[j]];
    }
    z.resize(n, 3);
    for (int i = 0; i < n; ++i) z.row(i) = permuted_.row(place[i]).head<3>();
}

Points MotionSolver::solve(const Pulls& pulls, double omega, const Points& start) {
    const auto apply = [&](const Points& u) {
        Points result = omega * (prior_ * u);
        for (Eigen::Index i = 0; i < u.rows(); ++i)
            result.row(i) += u.row(i) * pulls.trust[static_cast<std::size_t>(i)];
        return result;
    };
    Points rhs(pulls.pull.rows(), 3);
    for (Eigen::Index i = 0; i < rhs.rows(); ++i)
        rhs.row(i) = pulls.pull.row(i) * pulls.trust[static_cast<std::size_t>(i)];

    if (omega != factorised_omega_) factorise(pulls, omega);
    Points u = start, r = rhs - apply(u), z;
    // Not 0 where there is nothing to do.
    const double pulled = std::max({rhs.norm(), r.norm(), std::numeric_limits<double>::min()});
    precondition(r, z);
    Points p = z;
    double rz = dot(r, z);
    const double enough = kResidual * kResidual * rhs.squaredNorm();
    int iteration = 0;
    for (; iteration < kMaxIterations && r.squaredNorm() > enough; ++iteration) {
        const Points Ap = apply(p);
        const double step = rz / dot(p, Ap);
        u += step * p;
        r -= step * Ap;
        precondition(r, z);
        const double next = dot(r, z);
        p = z + next / rz * p;
        rz = next;
    }
    iterations_ += iteration;
    if (iteration > kQuick) factorised_omega_ = 0.0;  // a new one for the next call

    // Computed anew: a residual that is carried along does not see what rounding takes from a stiff system.
    const double left = (rhs - apply(u)).norm() / pulled;
    if (!(left <= kNoSolution)) {
        throw SolverFailure(
            fmt::format("alignment: the prior is too stiff for doubles, {:.2g} of the pull remains after {} "
                        "iterations; a smaller stiffness, membrane or bending helps",
                        left, iteration));
    }
    return u;
}

}  // namespace automorph
