#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>

#include "morph/mesh/mesh.h"

namespace automorph {

struct RegistrationOptions {
    std::uint64_t seed = 1;    ///< for sampling the surfaces and the starting rotations
    int max_iterations = 100;  ///< of EM-ICP, per refined start
};

/// The similarity that takes the source onto the target: y = scale * R * x + t. [Urtasun04] Sec. 4.1.
struct Registration {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< rotation, det = +1
    Eigen::Vector3d t = Eigen::Vector3d::Zero();      ///< in target units
    double scale = 1.0;      ///< target units per source unit, from the shapes' sizes; where another size
                             ///< within a third makes them the same, by that
    double sigma = 0.0;      ///< final sigma_p of Eq. (7), in target units
    double residual = 0.0;   ///< symmetric trimmed distance with normals, relative to the target's size
    double runner_up = 0.0;  ///< residual of the best clearly different pose (> 15 degrees away)
    int iterations = 0;
    bool converged = false;
    bool confident = false;  ///< runner_up is clearly worse: the pose is not a guess among equals

    Points apply(const Points& V) const;    ///< #V x 3, moved into the target's frame
    Points inverse(const Points& V) const;  ///< #V x 3 of the target's frame, moved into the source's
};

/// EM-ICP [Granger02], [Urtasun04] Sec. 4.1, from any initial rotation: many starting rotations on a coarse
/// sample, the best few refined, judged by a symmetric trimmed distance with normals. Shapes are registered
/// as size-normalised copies. Deterministic for a given seed, whatever the thread count.
Registration register_rigid(const Mesh& source, const Mesh& target, const RegistrationOptions& options = {});

/// Responsibilities p_ij of Eq. (6) for source vertices (rows) and target vertices (columns), truncated to
/// the `neighbours` nearest targets of each source vertex; rows sum to 1. #Va x #Vb, sigma is
/// registration.sigma.
Eigen::SparseMatrix<double, Eigen::RowMajor> responsibilities(const Points& source, const Points& target,
                                                              const Registration& registration,
                                                              int neighbours = 16);

}  // namespace automorph
