#pragma once

#include <utility>
#include <vector>

#include "morph/alignment/limbs.h"
#include "morph/alignment/motion_solver.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// Pulls matched limbs of the source onto the target's while they are away. Soft matches of what is near
/// would lead an arm that hangs to the hip of one that is raised; once a limb is there, they hold it better
/// than its rings.
class LimbPulls {
public:
    /// @param source, target  in units of the target's box diagonal
    /// @param weight          of the pull on a vertex, times its share of the source's area
    LimbPulls(const Mesh& source, const std::vector<std::vector<int>>& source_loops, const Mesh& target,
              const std::vector<std::vector<int>>& target_loops, double weight);

    /// Adds the pulls on limbs whose tips are away from their partners' to those of the surface.
    /// @param x  places now; the pulls are motions from `reference`
    void add(const Points& x, const Points& reference, Pulls& pulls) const;

    int source_limbs() const { return source_limbs_; }
    int target_limbs() const { return target_limbs_; }
    /// Vertices of source and target at the tips of matched limbs.
    const std::vector<std::pair<int, int>>& matched_tips() const { return matched_tips_; }

private:
    struct Pulled {
        int tip;
        Eigen::RowVector3d goal;  ///< of the tip
        std::vector<LimbPlace> places;
    };
    std::vector<Pulled> limbs_;
    Eigen::VectorXd weight_;  ///< per vertex
    int source_limbs_ = 0, target_limbs_ = 0;
    std::vector<std::pair<int, int>> matched_tips_;
};

}  // namespace automorph
