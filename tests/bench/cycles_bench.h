#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// Renders the benchmark's scenes with Cycles and with ours and prints how far apart the pictures are.
/// @param arguments  DIR [--spp N] [--size WxH] [SCENE]...; pictures of Cycles already in DIR are taken
/// @returns 0, or 1 if a difference is above what is allowed, 2 if the arguments are wrong
int cycles_bench(const std::vector<std::string>& arguments);

}  // namespace automorph::bench
