#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// Measures the path tracer on a mesh on a ground under a square light and a faint sky, beside the smallest
/// path tracer there can be on the same tree (minimal_tracer.h), in turns in one run; prints one table.
/// @param files  at most one mesh file; none: mannequin-devil.off of the example meshes
/// @return 0; 1 if both tracers' pictures differ by more than their noise; 2 on bad arguments
int render_bench(const std::vector<std::string>& files);

}  // namespace automorph::bench
