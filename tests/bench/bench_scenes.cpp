#include "tests/bench/bench_scenes.h"

#include <cmath>
#include <memory>

#include "morph/mesh/admit.h"
#include "morph/mesh/io.h"
#include "tests/render/day_sky.h"

namespace automorph::bench {
BenchMeshes read_bench_meshes(const std::string& file) {
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

const std::vector<BenchScene>& bench_scenes() {
    static const std::vector<BenchScene> scenes{{.name = "S1"},
                                                {.name = "S1s", .smooth = true},
                                                {.name = "S2", .metal = true},
                                                {.name = "S3", .map = true}};
    return scenes;
}

render::Color mesh_color(const BenchScene& scene) {
    return scene.metal ? render::Color(0.9f, 0.6f, 0.3f) : render::Color::Constant(0.7f);
}

render::Color ground_color() {
    return render::Color::Constant(0.5f);
}

render::RectangleLight bench_light() {
    return render::square_light({2.0f, -2.0f, 3.5f}, {0, 0, 0}, kLightSide, render::Color::Constant(40.0f));
}

render::Camera bench_camera() {
    render::Camera camera;
    camera.position = {0.0, -4.5, 1.0};
    camera.target = {0.0, 0.0, -0.1};
    camera.vertical_fov = 30.0;
    return camera;
}

const render::Image& bench_sky() {
    static const render::Image sky = render::day_sky();
    return sky;
}

Mesh torus(int around, int across) {
    constexpr double kTurn = 2.0 * 3.14159265358979323846;
    Mesh mesh;
    mesh.V.resize(around * across, 3);
    mesh.F.resize(2 * around * across, 3);
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double a = kTurn * i / around, b = kTurn * j / across, r = 0.7 + 0.3 * std::cos(b);
            mesh.V.row(i * across + j) << r * std::cos(a), r * std::sin(a), 0.3 * std::sin(b);
            const int next = (i + 1) % around * across, up = (j + 1) % across;
            mesh.F.row(2 * (i * across + j)) << i * across + j, next + j, next + up;
            mesh.F.row(2 * (i * across + j) + 1) << i * across + j, next + up, i * across + up;
        }
    }
    return mesh;
}

render::Scene make_scene(const BenchMeshes& meshes, const BenchScene& what) {
    render::Scene scene;
    render::MeshOptions options;
    options.normals = what.smooth ? render::Normals::Smooth : render::Normals::Flat;
    options.material.base_color = mesh_color(what);
    if (what.metal) {
        options.material.metallic = 1.0f;
        options.material.edge_color = options.material.base_color;
        options.material.roughness = std::sqrt(kMetalAlpha);
    }
    scene.add_mesh(meshes.mesh.V, meshes.mesh.F, options);
    render::MeshOptions ground;
    ground.normals = render::Normals::Flat;
    ground.material.base_color = ground_color();
    scene.add_mesh(meshes.ground.V, meshes.ground.F, ground);
    if (what.map) {
        scene.sky.map = std::make_shared<render::EquirectangularMap>(bench_sky());
    } else {
        scene.lights.push_back(bench_light());
        scene.sky.radiance.setConstant(kSkyRadiance);
    }
    return scene;
}

}  // namespace automorph::bench
