#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tests/bench/bench_scenes.h"

namespace automorph::bench {

/// A picture that Cycles, Blender's path tracer, shall make of a benchmark's scene.
struct CyclesJob {
    BenchScene scene;
    int width = 320, height = 240, spp = 64;
    int seed = 0;
    int threads = 1;
    std::filesystem::path output;  ///< linear EXR, absolute
};

/// Whether there is a program `blender` (Debian package blender).
bool cycles_is_installed();

/// Renders all jobs with one start of Blender. @param folder  for files in between
/// @returns by job the CPU seconds of rendering, tree included, start and files not
/// @throws Error with Blender's words if it fails
std::vector<double> run_cycles(const BenchMeshes& meshes, const std::vector<CyclesJob>& jobs,
                               const std::filesystem::path& folder);

}  // namespace automorph::bench
