#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// What pulls each vertex: (u_i - pull_i)^T trust_i (u_i - pull_i).
struct Pulls {
    Points pull;                         ///< #V x 3
    std::vector<Eigen::Matrix3d> trust;  ///< #V, symmetric positive semidefinite
};

/// Minimises sum_i (u_i - r_i)^T Q_i (u_i - r_i) + omega u^T S u over motions u of all vertices.
///
/// Method  conjugate gradients; preconditioner: one n x n factorisation of omega S + diag(tr Q_i / 3) for all
/// three
///         coordinates. Its pattern never changes, so the symbolic part is done once, and a factorisation
///         serves again while it still converges quickly.
class MotionSolver {
public:
    /// @param prior  S, symmetric positive semidefinite, #V x #V
    explicit MotionSolver(Eigen::SparseMatrix<double> prior);

    /// @param start  a first guess, #V x 3
    /// @throws SolverFailure  the factorisation failed, or omega is so large that rounding loses the pulls
    Points solve(const Pulls& pulls, double omega, const Points& start);

    int factorisations() const { return factorisations_; }
    int iterations() const { return iterations_; }

private:
    using Rows4 = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;  // the last column is padding

    void factorise(const Pulls& pulls, double omega);
    void precondition(const Points& r, Points& z);  // z = (omega S + diag)^-1 r

    Eigen::SparseMatrix<double> prior_;
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> preconditioner_;
    Rows4 permuted_;
    double factorised_omega_ = 0.0;
    int factorisations_ = 0, iterations_ = 0;
};

}  // namespace automorph
