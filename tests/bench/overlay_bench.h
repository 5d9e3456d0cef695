#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// Maps pairs of open meshes to the disk with a common border and overlays them, with morph/overlay and with
/// CGAL's Arrangement_2; prints one table (CPU seconds, medians of several repeats).
/// @param files  an even number of mesh files; none: pairs of the example meshes
/// @return 0; 1 if the two overlays differ in their number of vertices or faces; 2 on bad arguments
int overlay_bench(const std::vector<std::string>& files);

}  // namespace automorph::bench
