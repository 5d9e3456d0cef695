#include "render/integrator/render.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/integrator/camera_rays.h"
#include "render/integrator/denormals.h"
#include "render/integrator/path.h"
#include "render/integrator/splitting.h"
#include "render/sampler/sobol.h"

namespace automorph::render {
namespace {

void require(bool condition, const char* key, long long value, const char* allowed) {
    if (!condition) throw ConfigError(fmt::format("render: {} is {}; it must be {}", key, value, allowed));
}

void check(const RenderOptions& options) {
    require(options.spp >= 1, "spp", options.spp, "at least 1");
    require(options.pilot >= 2, "pilot", options.pilot, "at least 2");
    if (!(options.adaptive_error >= 0.0 && std::isfinite(options.adaptive_error)))
        throw ConfigError(
            fmt::format("render: adaptive_error is {}; it must be at least 0", options.adaptive_error));
    require(options.max_scatter >= 0, "max_scatter", options.max_scatter, "at least 0");
    require(options.threads >= 0, "threads", options.threads, "at least 1, or 0 for all");
    require(options.tile >= 1, "tile", options.tile, "at least 1");
}

constexpr int kFewSamples = 16;         // per pixel: up to here, the pilot would be much of the work
constexpr double kRaysPerSample = 3.0;  // about, with shadow rays; decides only how the tree is updated

struct Counts {
    std::uint64_t samples = 0, bad = 0, rays = 0;
};

// What is summed over the samples of a pixel.
struct PixelSums {
    Eigen::Array3d radiance = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
    std::uint32_t taken = 0, good = 0;

    void add(const Color& sample) {
        ++taken;
        if (!(sample.allFinite() && (sample >= 0.0f).all())) return;
        ++good;
        radiance += sample.cast<double>();
        squares += sample.cast<double>().square();
    }
    Eigen::Array3d mean() const { return radiance / std::max(1u, good); }
    // Of the mean of independent samples; stratified ones are better.
    Eigen::Array3d variance() const {
        if (good < 2) return Eigen::Array3d::Zero();
        const double n = good;
        return ((squares / n - mean().square()) / (n - 1.0)).max(0.0);
    }
};

/// The picture in the making, tile by tile.
class Film {
public:
    Film(const Scene& scene, const PathTracer& tracer, const PictureCamera& camera,
         const CameraRays& camera_rays, const RenderOptions& options)
        : scene_(scene),
          tracer_(tracer),
          camera_(camera),
          camera_rays_(camera_rays),
          options_(options),
          sums_(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height)),
          surfaces_(options.layers ? sums_.size() : 0),
          goals_(sums_.size(), static_cast<std::uint32_t>(options.spp)) {}

    int tile_count() const { return columns() * ((options_.height + options_.tile - 1) / options_.tile); }

    /// Brings each pixel of a tile to its number of samples, at most `limit`.
    Counts render(int tile, std::uint32_t limit) {
        const FlushDenormals flush;
        Counts counts;
        const int x0 = tile % columns() * options_.tile, y0 = tile / columns() * options_.tile;
        for (int y = y0; y < std::min(y0 + options_.tile, options_.height); ++y) {
            for (int x = x0; x < std::min(x0 + options_.tile, options_.width); ++x)
                pixel(x, y, limit, counts);
        }
        return counts;
    }

    /// Sets how many samples each pixel needs, from the variance of those it has and of its neighbours'.
    void judge() {
        for (int y = 0; y < options_.height; ++y) {
            for (int x = 0; x < options_.width; ++x) goals_[index(x, y)] = goal(x, y);
        }
    }

    void finish(RenderResult& result) const;

private:
    int columns() const { return (options_.width + options_.tile - 1) / options_.tile; }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(options_.width) +
               static_cast<std::size_t>(x);
    }

    std::uint32_t goal(int x, int y) const {
        double variance = 0.0;
        for (int j = std::max(0, y - 1); j <= std::min(options_.height - 1, y + 1); ++j) {
            for (int i = std::max(0, x - 1); i <= std::min(options_.width - 1, x + 1); ++i)
                variance = std::max(variance, luminance(sums_[index(i, j)].variance()));
        }
        const PixelSums& own = sums_[index(x, y)];
        constexpr double kDark = 0.01;  // radiance below which relative errors are not seen
        const double error = options_.adaptive_error * (luminance(own.mean()) + kDark);
        // Doubled until it suffices: powers of two times the pilot are stratified best.
        double needed = own.taken;
        while (variance * own.taken > error * error * needed && needed < options_.spp) needed *= 2.0;
        return static_cast<std::uint32_t>(std::min<double>(needed, options_.spp));
    }

    // Of the first mesh that a packet met: mostly the only one.
    void prepare_branches(const PixelSampler& random, std::uint32_t first,
                          const std::array<std::optional<Hit>, RayPacket::kSize>& hits,
                          SampleNumbers::Prepared& prepared) const {
        const auto met =
            std::find_if(hits.begin(), hits.end(), [](const auto& hit) { return hit.has_value(); });
        prepared.branches = met == hits.end() ? 1 : tracer_.branches((*met)->mesh);
        if (prepared.branches == 1) return;
        constexpr std::uint32_t kBatch = PixelSampler::kBatch;
        for (std::uint32_t i = 0; i < prepared.branches; ++i) {
            const std::uint32_t begin = first * prepared.branches + i * kBatch;
            random(begin, kScatter, prepared.scatter[i]);
            random(begin, kChoice, prepared.choice[i]);
        }
    }

    void pixel(int x, int y, std::uint32_t limit, Counts& counts) {
        const PixelSampler random(options_.seed, options_.frame, static_cast<std::uint32_t>(x),
                                  static_cast<std::uint32_t>(y));
        PixelSums sums = sums_[index(x, y)];
        const std::uint32_t before = sums.taken, bad_before = sums.taken - sums.good;
        const std::uint32_t end = std::min(limit, goals_[index(x, y)]);
        SampleNumbers::Prepared prepared;
        RayPacket packet;
        for (std::uint32_t first = sums.taken; first < end;
             first += static_cast<std::uint32_t>(packet.count)) {
            for (std::uint32_t pair = 0; pair < tracer_.usual_pairs(); ++pair)
                random(first, pair, prepared.pairs[pair]);
            packet.count = std::min<std::size_t>(RayPacket::kSize, end - first);
            for (std::size_t i = 0; i < packet.count; ++i) {
                packet.rays[i] =
                    camera_rays_(x, y, SampleNumbers(random, prepared, tracer_.usual_pairs(), first, i));
            }
            const auto hits = scene_.embree().intersect(packet);
            prepare_branches(random, first, hits, prepared);
            for (std::size_t i = 0; i < packet.count; ++i) {
                const SampleNumbers numbers(random, prepared, tracer_.usual_pairs(), first, i);
                FirstSurface surface;
                const Radiance found = tracer_.radiance(packet.rays[i], hits[i], numbers, counts.rays,
                                                        options_.layers ? &surface : nullptr);
                sums.add(found.sum());
                if (options_.layers) surfaces_[index(x, y)] += surface;
            }
        }
        sums_[index(x, y)] = sums;
        counts.samples += sums.taken - before;
        counts.bad += sums.taken - sums.good - bad_before;
    }

    const Scene& scene_;
    const PathTracer& tracer_;
    const PictureCamera& camera_;
    const CameraRays& camera_rays_;
    const RenderOptions& options_;
    std::vector<PixelSums> sums_;         // by pixel, rows from the top
    std::vector<FirstSurface> surfaces_;  // likewise, empty without layers
    std::vector<std::uint32_t> goals_;    // likewise: samples that the pixel needs
};

template <class Vector>
void store(const Vector& value, float* to) {
    for (Eigen::Index c = 0; c < value.size(); ++c) to[c] = static_cast<float>(value[c]);
}

void Film::finish(RenderResult& result) const {
    const int width = options_.width, height = options_.height;
    result.image = Image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) store(sums_[index(x, y)].mean(), result.image.at(x, y));
    }
    if (!options_.layers) return;

    constexpr float kNothing = -1.0f;
    Layers layers;
    layers.albedo = layers.shading_normal = layers.geometric_normal = layers.position = layers.variance =
        Image(width, height);
    layers.depth = Image(width, height, 1, std::numeric_limits<float>::infinity());
    layers.object = layers.face = Image(width, height, 1, kNothing);
    layers.samples = Image(width, height, 1);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const PixelSums& sums = sums_[index(x, y)];
            const FirstSurface& surfaces = surfaces_[index(x, y)];
            const float share = 1.0f / static_cast<float>(std::max(1u, sums.taken));
            store(share * surfaces.albedo, layers.albedo.at(x, y));
            store(share * surfaces.shading_normal, layers.shading_normal.at(x, y));
            store(share * surfaces.geometric_normal, layers.geometric_normal.at(x, y));
            store(sums.variance(), layers.variance.at(x, y));
            *layers.samples.at(x, y) = static_cast<float>(sums.good);
            const Ray ray{camera_.origin(),
                          camera_.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)};
            const std::optional<Hit> hit =
                scene_.embree().intersect(ray, std::numeric_limits<float>::infinity());
            if (!hit) continue;
            const Vec3 position = surface_point(scene_, *hit, ray).position;
            store(position, layers.position.at(x, y));
            *layers.depth.at(x, y) = (position - camera_.origin()).dot(camera_.forward());
            *layers.object.at(x, y) = static_cast<float>(hit->mesh);
            *layers.face.at(x, y) = static_cast<float>(hit->triangle);
        }
    }
    result.layers = std::move(layers);
}

// Renders all tiles up to `limit` samples. Progress goes from `begin` to `end`.
void render_tiles(Film& film, const RenderOptions& options, std::uint32_t limit, double begin, double end,
                  RenderResult& result) {
    std::mutex mutex;
    std::atomic<bool> stop{false};
    int finished = 0;
    const auto run = [&](const tbb::blocked_range<int>& range) {
        for (int tile = range.begin(); tile != range.end(); ++tile) {
            if (stop || (options.cancelled && options.cancelled())) {
                stop = true;
                return;
            }
            const Counts counts = film.render(tile, limit);
            const std::lock_guard lock(mutex);
            result.samples += counts.samples;
            result.bad_samples += counts.bad;
            result.rays += counts.rays;
            ++finished;
            const double share = static_cast<double>(finished) / film.tile_count();
            if (options.progress) options.progress(begin + share * (end - begin));
        }
    };
    tbb::parallel_for(tbb::blocked_range<int>(0, film.tile_count(), 1), run, tbb::simple_partitioner());
    result.cancelled = stop;
}

void render_film(Film& film, const RenderOptions& options, RenderResult& result) {
    constexpr auto kAll = std::numeric_limits<std::uint32_t>::max();
    if (options.adaptive_error > 0.0 && options.pilot < options.spp) {
        constexpr double kPilotShare = 0.25;  // of the progress: a guess
        render_tiles(film, options, static_cast<std::uint32_t>(options.pilot), 0.0, kPilotShare, result);
        film.judge();
        if (!result.cancelled) render_tiles(film, options, kAll, kPilotShare, 1.0, result);
    } else {
        render_tiles(film, options, kAll, 0.0, 1.0, result);
    }
    film.finish(result);
}

}  // namespace

RenderResult render(Scene& scene, const Camera& camera, const RenderOptions& options) {
    check(options);
    const PictureCamera view(camera, options.width, options.height);
    RenderResult result;

    const auto work = [&] {
        scene.commit(static_cast<double>(options.width) * options.height * options.spp * kRaysPerSample);
        const auto start = std::chrono::steady_clock::now();
        PathTracer tracer(scene, view, options);
        const CameraRays camera_rays(view, options.filter, scene.has_motion());
        if (options.split && options.spp > kFewSamples)
            tracer.split(choose_branches(scene, tracer, camera_rays, options, result.rays));
        Film film(scene, tracer, view, camera_rays, options);
        render_film(film, options, result);
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
