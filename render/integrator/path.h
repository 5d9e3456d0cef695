#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/geometry/embree_scene.h"
#include "render/geometry/scene.h"
#include "render/integrator/render.h"
#include "render/math/vec.h"
#include "render/sampler/sobol.h"

namespace automorph::render {

/// The random numbers of one camera ray and its path. Those that nearly every path takes are computed for a
/// whole batch of samples.
class SampleNumbers {
public:
    static constexpr std::uint32_t kPrepared =
        3;  ///< pairs: place in the pixel, first light and first scattering
    using Prepared = std::array<PixelSampler::Batch, kPrepared>;

    SampleNumbers(const PixelSampler& pixel, const Prepared& prepared, std::uint32_t first,
                  std::size_t offset)
        : pixel_(pixel), prepared_(prepared), first_(first), offset_(offset) {}

    Sample2 operator()(std::uint32_t pair) const {
        if (pair < kPrepared) return {prepared_[pair].u[offset_], prepared_[pair].v[offset_]};
        return pixel_(first_ + static_cast<std::uint32_t>(offset_), pair);
    }

private:
    const PixelSampler& pixel_;
    const Prepared& prepared_;
    std::uint32_t first_;
    std::size_t offset_;
};

/// What all paths of a picture share.
class PathTracer {
public:
    /// @pre the scene is committed and stays unchanged while this object lives
    PathTracer(const Scene& scene, const RenderOptions& options);

    /// Radiance along a camera ray with known first hit: one sample of the path integral. Thread-safe.
    /// @param rays  counts the rays traced
    Color radiance(Vec3 origin, Vec3 direction, std::optional<Hit> hit, const SampleNumbers& random,
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
