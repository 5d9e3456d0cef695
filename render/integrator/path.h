#pragma once

#include <cstdint>
#include <vector>

#include "render/geometry/scene.h"
#include "render/integrator/render.h"
#include "render/math/vec.h"
#include "render/sampler/sobol.h"

namespace automorph::render {

/// What all paths of a picture share.
class PathTracer {
public:
    /// @pre the scene is committed and stays unchanged while this object lives
    PathTracer(const Scene& scene, const RenderOptions& options);

    /// Radiance along a camera ray: one sample of the path integral. Thread-safe.
    /// @param rays  counts the rays traced
    Color radiance(Vec3 origin, Vec3 direction, const PixelSampler& random, std::uint32_t index,
                   std::uint64_t& rays) const;

private:
    struct Vertex;
    Color light_on_the_way(const Vec3& origin, const Vec3& direction, float far, int depth,
                           float bsdf_pdf) const;
    Color direct_light(const Vertex& vertex, Sample2 choice, Sample2 place, std::uint64_t& rays) const;
    Color catcher_albedo(const Vec3& position, const Vec3& normal) const;

    const Scene& scene_;
    const RenderOptions& options_;
    std::vector<float> light_probability_;  ///< of choosing each light, by power
    Color background_;
};

}  // namespace automorph::render
