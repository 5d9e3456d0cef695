#pragma once

#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/registration/nearest.h"

namespace automorph {

/// A surface as weighted oriented points.
struct OrientedPoints {
    Points points;           ///< #n x 3
    Points normals;          ///< #n x 3, unit or zero
    Eigen::VectorXd weight;  ///< #n, shares of the surface, sum 1
};

/// Vertices of a mesh with their normals and shares of its area.
OrientedPoints oriented_points(const Mesh& mesh);

/// Where each source point is drawn to, and how firmly.
struct SoftMatches {
    Points centre;                       ///< c_i = sum_j P_ij y_j / w_i
    Eigen::VectorXd weight;              ///< w_i = sum_j P_ij: small where the target has no partner
    std::vector<Eigen::Matrix3d> trust;  ///< Q_i: across the surface firmly, along it as far as the target's
                                         ///< shape near c_i says where along
};

/// How much of the target the source is a match for.
enum class Coverage {
    Whole,  ///< target points look for partners as source points do
    Part,   ///< they wait: those beyond the source's border would pull it over them
};

/// Soft matching between a moving source and a fixed target: Eq. (6) of [Urtasun04] in both directions at
/// once.
///
/// Method  features (x / position_scale, n / normal_scale), K_ij = exp(-d^2 / 2) over the pairs of nearest
///         neighbours in either direction, P = diag(a) K diag(b) by unbalanced Sinkhorn scaling [Chizat18]:
///         points without a partner go free.
class SoftMatching {
public:
    explicit SoftMatching(OrientedPoints target, Coverage coverage = Coverage::Whole);

    struct Scales {
        double position, normal;  ///< sigma of positions, in the target's unit, and of unit normals
    };
    SoftMatches match(const OrientedPoints& source, const Scales& scales) const;

private:
    OrientedPoints target_;
    double target_power_;                  ///< of the target's scalings; 0: there are none
    std::vector<Eigen::Matrix3d> spread_;  ///< per target vertex: covariance of its likes nearby
};

}  // namespace automorph
