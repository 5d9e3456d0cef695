#pragma once

#include <cstdint>
#include <vector>

namespace automorph::bench {

/// A square light of radiance `light` over a mesh of albedo `mesh_albedo` on a ground of `ground_albedo`,
/// under a constant sky: what the minimal tracer can show.
struct MinimalScene {
    std::vector<float> vertices, ground_vertices;            ///< #V x 3
    std::vector<std::uint32_t> triangles, ground_triangles;  ///< #F x 3
    float mesh_albedo = 0.7f, ground_albedo = 0.5f;
    float light = 40.0f, sky = 0.1f;
    float light_center[3] = {2.0f, -2.0f, 3.5f};  ///< faces the origin, side 1
};

struct MinimalResult {
    std::vector<float> pixels;  ///< height x width, grey radiance
    std::uint64_t rays = 0;
    double cpu_seconds = 0.0;  ///< of the rays, without building the tree
};

/// The smallest path tracer that gives the right picture, to measure ours against: one function on Embree's
/// single rays, the light sampled at each vertex, cosine-distributed bounces, random numbers of three shifts;
/// no materials, filter, roulette, stratification or multiple importance sampling. One thread. Camera as in
/// render_bench.cpp.
MinimalResult minimal_trace(const MinimalScene& scene, int width, int height, int spp, int max_scatter);

}  // namespace automorph::bench
