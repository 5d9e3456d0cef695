#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// What laying limbs on one another gives: pairs of the example meshes, with and without.
/// @param arguments  names of pairs "A B" of build/meshes; none: a list of animals and people
int limbs_bench(const std::vector<std::string>& arguments);

}  // namespace automorph::bench
