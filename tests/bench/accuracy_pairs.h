#pragma once

#include <optional>
#include <string>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph::bench {

/// Two meshes and where the first one's vertices belong on the second.
struct AccuracyPair {
    std::string name;
    Mesh source, target;
    Points truth;                             ///< #V of source x 3, in the target's frame
    std::vector<char> scored;                 ///< per vertex of source
    std::optional<Eigen::Matrix3d> rotation;  ///< from source to target, where known
};

/// Real pairs of a folder with gt_A_to_B_CROP.csv and .pose.json files, in the order of their names.
std::vector<AccuracyPair> real_pairs(const std::string& folder);

/// Pairs with exact truth: a shape against another tessellation of the same shape, posed and moved by a
/// smooth random warp of 2 to 4 % of the diagonal.
std::vector<AccuracyPair> synthetic_pairs(const std::string& folder);

/// Errors of predicted places, in percent of the diagonal of the target's bounding box.
struct AccuracyScore {
    double mean = 0, p95 = 0;
};
AccuracyScore score(const AccuracyPair& pair, const Points& predicted);

}  // namespace automorph::bench
