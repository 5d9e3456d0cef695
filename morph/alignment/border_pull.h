#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Which border of the target belongs to which of the source.
struct LoopPair {
    int source, target;  ///< indices of loops
};

/// Pairs boundary loops: the first (longest) with the first, the others with the nearest centroid, nearest
/// pairs first. Loops of the side that has more stay alone.
/// @param source_points, target_points  #V x 3 in one frame
std::vector<LoopPair> paired_loops(const Points& source_points,
                                   const std::vector<std::vector<int>>& source_loops,
                                   const Points& target_points,
                                   const std::vector<std::vector<int>>& target_loops);

/// The point of a closed polyline nearest to a query.
struct LoopPoint {
    int segment = 0;     ///< from loop vertex `segment` to the next
    double ratio = 0.0;  ///< 0..1 along it
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit, of the segment; zero if it has no length
};
LoopPoint nearest_on_loop(const Points& loop, const Eigen::Vector3d& query);

}  // namespace automorph
