#pragma once

#include <string>
#include <vector>

#include "morph/alignment/closest_point.h"
#include "morph/mesh/mesh.h"

namespace automorph::bench {

/// Two meshes and where points of the first one belong on the second.
struct AccuracyPair {
    std::string name, group;
    Mesh source, target;
    std::vector<SurfacePlace> places;  ///< the points on the source; empty: its vertices
    Points truth;                      ///< #points x 3, in the target's frame
    std::vector<char> scored;          ///< per point
};

/// Real pairs of a folder with gt_A_to_B_CROP.csv and .pose.json files, in the order of their names.
std::vector<AccuracyPair> real_pairs(const std::string& folder);

/// The same from B to A: the true points on B are the points, A's vertices their truth.
std::vector<AccuracyPair> reversed_pairs(const std::vector<AccuracyPair>& pairs);

/// Pairs with exact truth: a shape against another tessellation of the same shape, posed and moved by a
/// smooth random warp of 2 to 4 % of the diagonal.
std::vector<AccuracyPair> synthetic_pairs(const std::string& folder);

/// The synthetic pairs of 2 % with noise of 0.5 % of the diagonal on the target's vertices, as scans have;
/// and mirrored.
std::vector<AccuracyPair> noisy_pairs(const std::string& folder);

/// Errors of predicted places, in percent of the diagonal of the target's bounding box.
struct AccuracyScore {
    double mean = 0, p95 = 0;
};
/// @param predicted  #V of source x 3: where its vertices went
AccuracyScore score(const AccuracyPair& pair, const Points& predicted);

}  // namespace automorph::bench
