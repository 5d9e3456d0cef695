#include "tests/bench/moving_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

#include "morph/mesh/admit.h"
#include "morph/morph.h"
#include "morph/shapes/shapes.h"
#include "render/integrator/render.h"
#include "tests/bench/bench_scenes.h"

namespace automorph::bench {
namespace {

double cpu_now() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A scene whose tree is either built anew for each frame or refitted.
struct Moving {
    explicit Moving(bool refit) : scene({.embree_config = "", .refit = refit}) {}

    render::Scene scene;
    double update = 0.0;   ///< CPU seconds of the last frame's tree
    double per_ray = 0.0;  ///< CPU seconds of the last frame
};

void show(Moving& moving, const Points& V) {
    constexpr int kUpdates = 5;
    render::RenderOptions options;
    options.width = 320;
    options.height = 240;
    options.spp = 16;
    options.max_scatter = kMaxScatter;
    options.threads = 1;
    double best = 1e9;
    for (int k = 0; k < kUpdates; ++k) {
        moving.scene.move_mesh(0, V);
        const double start = cpu_now();
        moving.scene.commit();
        best = std::min(best, cpu_now() - start);
    }
    moving.update = best;
    best = 1e9;
    for (int k = 0; k < 2; ++k) {
        const double start = cpu_now();
        const render::RenderResult picture = render::render(moving.scene, bench_camera(), options);
        best = std::min(best, (cpu_now() - start) / static_cast<double>(picture.rays));
    }
    moving.per_ray = best;
}

}  // namespace

void moving_bench() {
    constexpr int kFrames = 8;
    const InputMesh a = admit_mesh(ellipsoid({1, 0.8, 0.5}, {.triangles = 8000}), "ellipsoid"),
                    b = admit_mesh(star({}, {.triangles = 8000}), "star");
    const Morph m = morph(a, b);
    Moving built(false), refitted(true);
    for (Moving* moving : {&built, &refitted}) {
        moving->scene.add_mesh(m.frame(0.0), m.triangles(), {});
        moving->scene.lights.push_back(bench_light());
        moving->scene.sky.radiance.setConstant(kSkyRadiance);
    }
    const auto triangles = static_cast<double>(m.triangles().rows());
    fmt::print(
        "moving   {} triangles from ellipsoid to star:   tree built    refitted   rays slower   worth "
        "building from\n",
        m.triangles().rows());
    for (int frame = 0; frame <= kFrames; ++frame) {
        const double alpha = static_cast<double>(frame) / kFrames;
        const Points V = m.frame(alpha);
        show(built, V);
        show(refitted, V);
        const double saved = built.update - refitted.update, lost = refitted.per_ray - built.per_ray;
        fmt::print(
            "         alpha {:.3f}                                  {:7.1f} ms  {:7.1f} ms   {:8.1f} %   "
            "{}\n",
            alpha, 1e3 * built.update, 1e3 * refitted.update, 100 * lost / built.per_ray,
            lost > 0.0 ? fmt::format("{:.0f} rays per triangle", saved / lost / triangles) : "never");
        std::fflush(stdout);
    }
}

}  // namespace automorph::bench
