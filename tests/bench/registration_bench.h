#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// Registers meshes with their own re-tessellations in random poses and scales: clean, with noise of 1 and 3
/// % of the diagonal on both, and with 20 % of the target cut away. Prints a row per mesh, the shares, and
/// the time at 10,000 vertices.
/// @param arguments  --poses N (default 5) of each kind per mesh, --seed N, --only TEXT
/// @return 0; 2 if an argument is wrong or the meshes are not there
int registration_bench(const std::vector<std::string>& arguments);

}  // namespace automorph::bench
