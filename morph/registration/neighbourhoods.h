#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/registration/nearest.h"

namespace automorph {

/// The rows of Eq. (6), truncated to the k nearest targets of each source point at one pose.
class Neighbourhoods {
public:
    Neighbourhoods(const NearestPoints<3>& target, Eigen::Index source_count, int neighbours);

    /// Finds the neighbours of all points, in parallel. Twice as many as needed are remembered: while a point
    /// stays near the place of its last query, its nearest are among them, exactly, and the tree is not
    /// asked.
    /// @param moved  source points in the target's frame
    void find(const Points& moved);

    /// sigma_p of Eq. (7) at the pose last looked up.
    double sigma() const;

    /// sum_j p_ij y_j for each source point i.
    /// @param y  one row per target point: its position, its normal, ...
    Points expected(const Points& y, double sigma) const;

private:
    void look_up(Eigen::Index i, const Eigen::RowVector3d& point);
    bool reorder_known(Eigen::Index i, const Eigen::RowVector3d& point);  // false if the tree must be asked

    const NearestPoints<3>& tree_;
    Eigen::Index source_count_;
    int k_, known_;           // p_ij kept per row, targets remembered per row
    Points looked_up_at_;     // where each point was when the tree was asked
    Eigen::VectorXd radius_;  // the ball about that place in which all targets are remembered
    std::vector<std::uint32_t> target_;
    std::vector<double> squared_distance_;
};

/// One row of Eq. (6): p_j = exp(-d_j^2 / 2 sigma^2) / sum_k exp(-d_k^2 / 2 sigma^2), computed relative to
/// the nearest target, so that no row underflows: where sigma is very small or 0, the nearest has p = 1.
///
/// @param squared_distances  #k, ascending
/// @param p                  #k, the result, of sum 1
void responsibility_row(const double* squared_distances, int k, double sigma, double* p);

}  // namespace automorph
