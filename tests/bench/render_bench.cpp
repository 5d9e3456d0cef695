#include "tests/bench/render_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "morph/mesh/admit.h"
#include "morph/mesh/io.h"
#include "render/integrator/render.h"
#include "tests/bench/minimal_tracer.h"

namespace automorph::bench {
namespace {

constexpr int kWidth = 320, kHeight = 240, kSpp = 64, kRepeats = 5, kMaxScatter = 6;

/// The mesh in the unit ball about the centre of its box, and the ground it stands on.
struct BenchMeshes {
    Mesh mesh, ground;
};

BenchMeshes read_meshes(const std::string& file) {
    BenchMeshes result;
    result.mesh = admit(read_mesh(file), file).mesh;
    Points& V = result.mesh.V;
    V.rowwise() -= (0.5 * (V.colwise().minCoeff() + V.colwise().maxCoeff())).eval();
    V /= V.rowwise().norm().maxCoeff();
    const double z = V.col(2).minCoeff();
    result.ground.V.resize(4, 3);
    result.ground.V << -10, -10, z, 10, -10, z, 10, 10, z, -10, 10, z;
    result.ground.F.resize(2, 3);
    result.ground.F << 0, 1, 2, 0, 2, 3;
    return result;
}

render::Scene make_scene(const BenchMeshes& meshes) {
    render::Scene scene;
    render::MeshOptions options;
    options.normals = render::Normals::Flat;
    options.material.base_color.setConstant(0.7f);
    scene.add_mesh(meshes.mesh.V, meshes.mesh.F, options);
    options.material.base_color.setConstant(0.5f);
    scene.add_mesh(meshes.ground.V, meshes.ground.F, options);
    scene.lights.push_back(
        render::square_light({2.0f, -2.0f, 3.5f}, {0, 0, 0}, 1.0f, render::Color::Constant(40.0f)));
    scene.sky.radiance.setConstant(0.1f);
    return scene;
}

MinimalScene make_minimal_scene(const BenchMeshes& meshes) {
    MinimalScene scene;
    const auto copy = [](const Mesh& from, std::vector<float>& vertices,
                         std::vector<std::uint32_t>& triangles) {
        for (Eigen::Index i = 0; i < from.V.size(); ++i)
            vertices.push_back(static_cast<float>(from.V.data()[i]));
        for (Eigen::Index i = 0; i < from.F.size(); ++i)
            triangles.push_back(static_cast<std::uint32_t>(from.F.data()[i]));
    };
    copy(meshes.mesh, scene.vertices, scene.triangles);
    copy(meshes.ground, scene.ground_vertices, scene.ground_triangles);
    return scene;
}

render::Camera bench_camera() {
    render::Camera camera;
    camera.position = {0.0, -4.5, 1.0};
    camera.target = {0.0, 0.0, -0.1};
    camera.vertical_fov = 30.0;
    return camera;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Prints how fast both are; returns whether they show the same.
bool against_minimal(const BenchMeshes& meshes) {
    render::Scene scene = make_scene(meshes);
    const MinimalScene minimal = make_minimal_scene(meshes);
    render::RenderOptions options;
    options.width = kWidth;
    options.height = kHeight;
    options.spp = kSpp;
    options.max_scatter = kMaxScatter;
    options.roulette_after = kMaxScatter;  // the same rays
    options.filter = render::Filter::Box;
    options.threads = 1;

    std::vector<double> ours, theirs, ratios;
    double our_mean = 0.0, their_mean = 0.0;
    for (int k = 0; k <= kRepeats; ++k) {
        const double start = cpu_seconds();
        const render::RenderResult a = render::render(scene, bench_camera(), options);
        const double seconds = cpu_seconds() - start;
        const MinimalResult b = minimal_trace(minimal, kWidth, kHeight, kSpp, kMaxScatter);
        if (k == 0) continue;  // warm up
        ours.push_back(1e-6 * static_cast<double>(a.rays) / seconds);
        theirs.push_back(1e-6 * static_cast<double>(b.rays) / b.cpu_seconds);
        ratios.push_back(ours.back() / theirs.back());
        our_mean = their_mean = 0.0;
        for (const float x : a.image.pixels) our_mean += static_cast<double>(x) / (3.0 * kWidth * kHeight);
        for (const float x : b.pixels) their_mean += static_cast<double>(x) / (1.0 * kWidth * kHeight);
    }
    fmt::print(
        "path tracer      {:8.2f} million rays per CPU second\n"
        "minimal tracer   {:8.2f}\n"
        "ratio            {:8.3f}   (of {} pairs, median; {:.3f} to {:.3f})\n"
        "mean radiance    {:8.5f} and {:.5f}\n",
        median(ours), median(theirs), median(ratios), kRepeats,
        *std::min_element(ratios.begin(), ratios.end()), *std::max_element(ratios.begin(), ratios.end()),
        our_mean, their_mean);
    constexpr double kSame = 5e-4;  // relative; the noise of the mean is a tenth of it
    return std::abs(our_mean - their_mean) <= kSame * their_mean;
}

}  // namespace

int render_bench(const std::vector<std::string>& files) {
    if (files.size() > 1) {
        fmt::print(stderr, "automorph_bench render: {} files; expected one mesh or none\n", files.size());
        return 2;
    }
    const std::string file = files.empty() ? AUTOMORPH_DEMO_MESHES "/mannequin-devil.off" : files.front();
    const BenchMeshes meshes = read_meshes(file);
    fmt::print("{}: {} triangles on a ground, {} x {} pixels, {} samples, one thread\n", file,
               meshes.mesh.triangle_count(), kWidth, kHeight, kSpp);
    const bool same = against_minimal(meshes);
    if (!same) fmt::print("the pictures differ\n");
    return same ? 0 : 1;
}

}  // namespace automorph::bench
