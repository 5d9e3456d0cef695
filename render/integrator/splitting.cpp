#include "render/integrator/splitting.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/integrator/denormals.h"

namespace automorph::render {
namespace {

constexpr int kStride = 10;             // pixels from one of the pilot to the next
constexpr std::uint32_t kSamples = 16;  // of each of two independent estimates of a pixel of the pilot
// Not the picture's own numbers: samples must not know how they will be split. And the same for all pictures,
// so that seeds and still frames are split alike.
constexpr std::uint64_t kSeed = 0x6a09e667f3bcc908ull;
constexpr double kDark = 0.01;  // radiance below which relative errors are not seen

/// Noise, in squares of the pixel's radiance, and rays of the samples of one mesh.
struct Shares {
    double near = 0.0, far = 0.0;
    double near_rays = 0.0, far_rays = 0.0;

    Shares& operator+=(const Shares& other) {
        near += other.near;
        far += other.far;
        near_rays += other.near_rays;
        far_rays += other.far_rays;
        return *this;
    }
};

struct PilotPixel {
    std::uint32_t mesh = 0;  // the first that was met
    Shares shares;           // of the samples that met it
};

/// Means over the samples that met the pixel's mesh.
struct Estimate {
    double near = 0.0, far = 0.0, count = 0.0;
};

Estimate estimate(const Scene& scene, const PathTracer& tracer, const CameraRays& camera_rays, int x, int y,
                  const PixelSampler& sampler, PilotPixel& pixel) {
    Estimate sums;
    const SampleNumbers::Prepared none{};
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const SampleNumbers random(sampler, none, 0, i, 0);
        const Ray ray = camera_rays(x, y, random);
        if (!traceable(ray)) continue;
        const std::optional<Hit> hit = scene.embree().intersect(ray, kInfinity);
        if (!hit) continue;
        if (pixel.shares.near_rays == 0.0) pixel.mesh = hit->mesh;
        if (hit->mesh != pixel.mesh) continue;
        std::uint64_t rays = 0;
        const Radiance found = tracer.radiance(ray, hit, random, rays, nullptr);
        pixel.shares.far_rays += static_cast<double>(found.far_rays);
        pixel.shares.near_rays += static_cast<double>(rays - found.far_rays);
        if (!found.sum().isFinite().all()) continue;
        sums.near += luminance(found.near);
        sums.far += luminance(found.far);
        ++sums.count;
    }
    sums.near /= std::max(1.0, sums.count);
    sums.far /= std::max(1.0, sums.count);
    return sums;
}

// Two estimates differ by what stratification leaves of the noise.
PilotPixel pilot_pixel(const Scene& scene, const PathTracer& tracer, const CameraRays& camera_rays, int x,
                       int y) {
    PilotPixel pixel;
    const auto take = [&](std::uint64_t which) {
        const PixelSampler sampler(kSeed + which, 0, static_cast<std::uint32_t>(x),
                                   static_cast<std::uint32_t>(y));
        return estimate(scene, tracer, camera_rays, x, y, sampler, pixel);
    };
    const Estimate a = take(0), b = take(1);
    if (a.count == 0.0 || b.count == 0.0) return pixel;
    const double scale = 0.5 * (a.near + a.far + b.near + b.far) + kDark;
    pixel.shares.near = (a.near - b.near) * (a.near - b.near) / (scale * scale);
    pixel.shares.far = (a.far - b.far) * (a.far - b.far) / (scale * scale);
    return pixel;
}

std::uint32_t best_branches(const Shares& shares) {
    constexpr double kMost = kMostBranches;
    if (!(shares.far > 0.0 && shares.far_rays > 0.0)) return 1;
    const double ratio = shares.far * shares.near_rays / (shares.near * shares.far_rays);  // may be infinite
    return static_cast<std::uint32_t>(std::clamp(std::sqrt(ratio) + 0.5, 1.0, kMost));
}

}  // namespace

std::vector<std::uint32_t> choose_branches(const Scene& scene, const PathTracer& tracer,
                                           const CameraRays& camera_rays, const RenderOptions& options,
                                           std::uint64_t& rays) {
    const int columns = (options.width + kStride / 2) / kStride,
              rows = (options.height + kStride / 2) / kStride;
    std::vector<PilotPixel> pixels(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    tbb::parallel_for(tbb::blocked_range<int>(0, rows), [&](const tbb::blocked_range<int>& range) {
        const FlushDenormals flush;
        for (int j = range.begin(); j != range.end(); ++j) {
            for (int i = 0; i < columns; ++i) {
                const int x = kStride * i + kStride / 2, y = kStride * j + kStride / 2;
                pixels[static_cast<std::size_t>(j * columns + i)] =
                    pilot_pixel(scene, tracer, camera_rays, x, y);
            }
        }
    });
    // In the pixels' order, so that threads do not matter.
    std::vector<Shares> shares(static_cast<std::size_t>(scene.mesh_count()));
    for (const PilotPixel& pixel : pixels) {
        rays += static_cast<std::uint64_t>(pixel.shares.near_rays + pixel.shares.far_rays);
        if (!shares.empty()) shares[pixel.mesh] += pixel.shares;
    }
    std::vector<std::uint32_t> branches;
    for (const Shares& each : shares) branches.push_back(best_branches(each));
    return branches;
}

}  // namespace automorph::render
