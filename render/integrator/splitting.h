#pragma once

#include <cstdint>
#include <vector>

#include "render/integrator/camera_rays.h"
#include "render/integrator/path.h"

namespace automorph::render {

/// How many paths should go on from each mesh where a camera ray meets it: a number for PathTracer::split().
///
/// Method  a pilot with random numbers of its own takes two estimates, of 16 samples each, of every tenth
/// pixel
///         across and down. Their differences tell the noise of what the paths bring that go on (V) from that
///         of the first surface's own light (v), each as stratification leaves it; and it counts the rays
///         that both take (R, r). With k paths a sample's noise is v + V / k at a price of r + k R; their
///         product is least for k = sqrt(V r / (v R)), rounded, within [1, kMostBranches]: metal that throws
///         light on the ground asks for more, lamps alone for one [Bolin97], [Rath22].
/// Cost    half a per cent of the samples of a picture with 64 per pixel.
/// @param rays  counts the rays traced
std::vector<std::uint32_t> choose_branches(const Scene& scene, const PathTracer& tracer,
                                           const CameraRays& camera_rays, const RenderOptions& options,
                                           std::uint64_t& rays);

}  // namespace automorph::render
