#include "tests/bench/moving_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
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
    explicit Moving(render::TreeUpdate how) : scene({.embree_config = "", .moved = how}) {}

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
        moving.scene.commit(0.0);
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

/// Prints a line per frame.
void measure(const std::string& name, const Triangles& F, const std::vector<Points>& frames) {
    Moving built(render::TreeUpdate::Build), refitted(render::TreeUpdate::Refit);
    for (Moving* moving : {&built, &refitted}) {
        moving->scene.add_mesh(frames.front(), F, {});
        moving->scene.lights.push_back(bench_light());
        moving->scene.sky.radiance.setConstant(kSkyRadiance);
    }
    fmt::print("moving   {}, {} triangles: tree built, refitted, rays slower, building pays from\n", name,
               F.rows());
    for (std::size_t i = 0; i < frames.size(); ++i) {
        show(built, frames[i]);
        show(refitted, frames[i]);
        const double saved = built.update - refitted.update, lost = refitted.per_ray - built.per_ray;
        const double worth = saved / lost / static_cast<double>(F.rows());
        fmt::print("         {:5.3f} {:8.1f} ms {:7.1f} ms {:7.1f} %   {}\n",
                   static_cast<double>(i) / static_cast<double>(frames.size() - 1), 1e3 * built.update,
                   1e3 * refitted.update, 100 * lost / built.per_ray,
                   lost > 0.0 ? fmt::format("{:.0f} rays per triangle", worth) : "never");
        std::fflush(stdout);
    }
}

/// Turned about the z-axis the further the higher, by `turns` revolutions from top to bottom.
Points twisted(const Points& V, double turns) {
    const double z0 = V.col(2).minCoeff(), height = V.col(2).maxCoeff() - z0;
    Points result = V;
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        const double angle = 2.0 * 3.14159265358979323846 * turns * (V(i, 2) - z0) / height;
        result(i, 0) = std::cos(angle) * V(i, 0) - std::sin(angle) * V(i, 1);
        result(i, 1) = std::sin(angle) * V(i, 0) + std::cos(angle) * V(i, 1);
    }
    return result;
}

}  // namespace

void moving_bench() {
    const InputMesh a = admit_mesh(ellipsoid({1, 0.8, 0.5}, {.triangles = 8000}), "ellipsoid"),
                    b = admit_mesh(star({}, {.triangles = 8000}), "star");
    const Morph m = morph(a, b);
    std::vector<Points> frames;
    for (const double alpha : {0.0, 0.25, 0.5, 0.75, 1.0}) frames.push_back(m.frame(alpha));
    measure("ellipsoid to star", m.triangles(), frames);

    const Mesh mesh = torus(1000, 500);
    frames.clear();
    for (const double turns : {0.0, 0.25, 0.5}) frames.push_back(twisted(mesh.V, turns));
    measure("torus twisted by half a revolution", mesh.F, frames);
}

}  // namespace automorph::bench
