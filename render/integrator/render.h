#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "render/camera/camera.h"
#include "render/film/filter.h"
#include "render/film/image.h"
#include "render/film/layers.h"
#include "render/geometry/scene.h"

namespace automorph::render {

/// Which samples estimate the light of rectangles. All have the same mean.
enum class LightStrategy {
    Both,    ///< light and scattering samples, weighted by the power heuristic [Veach95]
    Lights,  ///< points on the lights only
    Scatter  ///< scattered rays only
};

struct RenderOptions {
    int width = 640;   ///< pixels
    int height = 480;  ///< pixels
    int spp = 64;      ///< samples per pixel, at most if adaptive; powers of two are stratified best
    /// Standard error of a pixel's luminance, relative to the luminance + 0.01, at which its samples suffice;
    /// 0: all pixels take `spp`. Judged by the first `pilot` samples of the pixel and its eight neighbours.
    double adaptive_error = 0.0;
    int pilot = 16;       ///< samples that every pixel takes, if adaptive
    bool layers = false;  ///< fills RenderResult::layers
    int max_scatter = 6;  ///< longest path: scattering vertices between camera and light; 0 sees lights only
    std::uint64_t seed = 0;   ///< pictures with different seeds have independent noise
    std::uint32_t frame = 0;  ///< likewise for the frames of a sequence
    Filter filter = Filter::BlackmanHarris;
    LightStrategy lights = LightStrategy::Both;
    int roulette_after = 3;  ///< scattering vertices before Russian roulette may end a path
    /// Whether several paths may go on from the first surface of a sample, where most of the noise is theirs
    /// (splitting.h). Pictures of 16 samples or fewer are never split.
    bool split = true;

    int threads = 0;  ///< 0: all. The picture does not depend on it
    int tile = 16;    ///< side of the square of pixels that a thread takes at a time; no influence either
    /// Called with the finished fraction in (0, 1], never from two threads at once. May be empty.
    std::function<void(double)> progress;
    /// Asked before each tile, from any thread; once true, no further tile is begun. May be empty.
    std::function<bool()> cancelled;
};

struct RenderResult {
    Image image;                    ///< mean radiance per pixel, RGB
    std::optional<Layers> layers;   ///< if asked for
    std::uint64_t samples = 0;      ///< taken
    std::uint64_t bad_samples = 0;  ///< dropped because not finite or negative; 0 expected
    std::uint64_t rays = 0;         ///< traced, shadow rays included
    double wall_seconds = 0.0;      ///< without building the tree
    bool cancelled = false;         ///< if so, some tiles are black
};

/// Renders a picture by path tracing with next-event estimation, without clamping.
///
/// The noise depends on seed, frame, pixel and sample number only, so the bits are the same for any number of
/// threads and any tile size.
/// @throws ConfigError if an option is out of range or the camera is not valid
/// @throws Error       with Embree's message
RenderResult render(Scene& scene, const Camera& camera, const RenderOptions& options);

}  // namespace automorph::render
