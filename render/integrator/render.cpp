#include "render/integrator/render.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>

#include "morph/mesh/errors.h"
#include "render/integrator/path.h"
#include "render/sampler/sobol.h"

namespace automorph::render {
namespace {

void require(bool condition, const char* key, long long value, const char* allowed) {
    if (!condition) throw ConfigError(fmt::format("render: {} is {}; it must be {}", key, value, allowed));
}

void check(const RenderOptions& options) {
    require(options.spp >= 1, "spp", options.spp, "at least 1");
    require(options.max_scatter >= 0, "max_scatter", options.max_scatter, "at least 0");
    require(options.threads >= 0, "threads", options.threads, "at least 1, or 0 for all");
    require(options.tile >= 1, "tile", options.tile, "at least 1");
}

// Embree wants denormal numbers flushed to zero; set on every thread alike, so that all compute the same
// bits.
class FlushDenormals {
public:
    FlushDenormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kFlushToZero | kDenormalsAreZero); }
    ~FlushDenormals() { _mm_setcsr(before_); }
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
    static constexpr unsigned kFlushToZero = 0x8000, kDenormalsAreZero = 0x0040;
    unsigned before_;
};

struct Counts {
    std::uint64_t samples = 0, bad = 0, rays = 0;
};

class Tiles {
public:
    Tiles(const Scene& scene, const PathTracer& tracer, const PinholeCamera& camera,
          const RenderOptions& options, Image& image)
        : scene_(scene),
          tracer_(tracer),
          camera_(camera),
          options_(options),
          filter_(options.filter),
          image_(image) {}

    int count() const { return columns() * ((options_.height + options_.tile - 1) / options_.tile); }

    Counts render(int tile) const {
        const FlushDenormals flush;
        Counts counts;
        const int x0 = tile % columns() * options_.tile, y0 = tile / columns() * options_.tile;
        for (int y = y0; y < std::min(y0 + options_.tile, options_.height); ++y) {
            for (int x = x0; x < std::min(x0 + options_.tile, options_.width); ++x) pixel(x, y, counts);
        }
        return counts;
    }

private:
    int columns() const { return (options_.width + options_.tile - 1) / options_.tile; }

    void pixel(int x, int y, Counts& counts) const {
        const PixelSampler random(options_.seed, options_.frame, static_cast<std::uint32_t>(x),
                                  static_cast<std::uint32_t>(y));
        Eigen::Array3d sum = Eigen::Array3d::Zero();
        std::uint32_t good = 0;
        SampleNumbers::Prepared prepared;
        RayPacket packet;
        const auto spp = static_cast<std::uint32_t>(options_.spp);
        for (std::uint32_t first = 0; first < spp; first += static_cast<std::uint32_t>(RayPacket::kSize)) {
            for (std::uint32_t pair = 0; pair < tracer_.usual_pairs(); ++pair)
                random(first, pair, prepared[pair]);
            packet.count = std::min<std::size_t>(RayPacket::kSize, spp - first);
            for (std::size_t i = 0; i < packet.count; ++i) {
                packet.rays[i] = {
                    camera_.origin(),
                    camera_.direction(static_cast<float>(x) + 0.5f + filter_(prepared[kPixel].u[i]),
                                      static_cast<float>(y) + 0.5f + filter_(prepared[kPixel].v[i]))};
            }
            const auto hits = scene_.embree().intersect(packet);
            for (std::size_t i = 0; i < packet.count; ++i) {
                const SampleNumbers numbers(random, prepared, tracer_.usual_pairs(), first, i);
                const Color radiance = tracer_.radiance(packet.rays[i], hits[i], numbers, counts.rays);
                if (radiance.allFinite() && (radiance >= 0.0f).all()) {
                    sum += radiance.cast<double>();
                    ++good;
                }
            }
        }
        counts.samples += static_cast<std::uint64_t>(options_.spp);
        counts.bad += static_cast<std::uint64_t>(options_.spp) - good;
        const Color mean = good > 0 ? Color((sum / good).cast<float>()) : Color::Zero();
        std::copy(mean.data(), mean.data() + 3, image_.at(x, y));
    }

    const Scene& scene_;
    const PathTracer& tracer_;
    const PinholeCamera& camera_;
    const RenderOptions& options_;
    FilterSampler filter_;
    Image& image_;
};

void render_tiles(const Tiles& tiles, const RenderOptions& options, RenderResult& result) {
    std::mutex mutex;
    std::atomic<bool> stop{false};
    int finished = 0;
    const auto run = [&](const tbb::blocked_range<int>& range) {
        for (int tile = range.begin(); tile != range.end(); ++tile) {
            if (stop || (options.cancelled && options.cancelled())) {
                stop = true;
                return;
            }
            const Counts counts = tiles.render(tile);
            const std::lock_guard lock(mutex);
            result.samples += counts.samples;
            result.bad_samples += counts.bad;
            result.rays += counts.rays;
            ++finished;
            if (options.progress) options.progress(static_cast<double>(finished) / tiles.count());
        }
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, tiles.count(), 1), run, tbb::simple_partitioner());
    result.cancelled = stop;
}

}  // namespace

RenderResult render(Scene& scene, const Camera& camera, const RenderOptions& options) {
    check(options);
    const PinholeCamera pinhole(camera, options.width, options.height);
    RenderResult result;
    result.image = Image(options.width, options.height);

    const auto work = [&] {
        scene.commit();
        const auto start = std::chrono::steady_clock::now();
        const PathTracer tracer(scene, options);
        render_tiles(Tiles(scene, tracer, pinhole, options, result.image), options, result);
        result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    };
    if (options.threads == 0) {
        work();
    } else {
        // More threads than cores are given too, if asked for: tests use them.
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(options.threads));
        tbb::task_arena(options.threads).execute(work);
    }
    return result;
}

}  // namespace automorph::render
