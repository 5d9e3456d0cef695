#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// Prints what the path tracer costs, each figure beside what it is measured against, taken in turns in one
/// run: rays per CPU second, two threads, memory, moving a mesh, start of the program, noise per CPU second,
/// what the denoiser gains.
/// @param arguments  the parts to measure (rays, threads, memory, moving, start, noise, denoise), or none for
/// all
/// @returns 0, or 1 if pictures that must show the same differ, 2 if the arguments are wrong
int render_bench(const std::vector<std::string>& arguments);

}  // namespace automorph::bench
