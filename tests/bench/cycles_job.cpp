#include "tests/bench/cycles_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "morph/mesh/errors.h"
#include "render/image/image_file.h"

namespace automorph::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

json numbers(const render::Color& c) {
    return {c[0], c[1], c[2]};
}
json numbers(const Eigen::Vector3d& v) {
    return {v[0], v[1], v[2]};
}

json mesh_json(const Mesh& mesh, json material) {
    json vertices = json::array(), triangles = json::array();
    for (Eigen::Index i = 0; i < mesh.V.rows(); ++i)
        vertices.push_back(numbers(mesh.V.row(i).transpose().eval()));
    for (Eigen::Index i = 0; i < mesh.F.rows(); ++i)
        triangles.push_back({mesh.F(i, 0), mesh.F(i, 1), mesh.F(i, 2)});
    return {{"vertices", vertices}, {"triangles", triangles}, {"material", std::move(material)}};
}

/// The normals that our path tracer interpolates, by vertex.
json normals_json(const Mesh& mesh, const render::TriangleMesh& ours) {
    std::vector<render::Vec3> normals(static_cast<std::size_t>(mesh.V.rows()),
                                      render::Vec3(0.0f, 0.0f, 1.0f));
    for (Eigen::Index t = 0; t < mesh.F.rows(); ++t) {
        const std::array<render::Vec3, 3> corners = ours.corner_normals(static_cast<std::uint32_t>(t));
        for (int k = 0; k < 3; ++k)
            normals[static_cast<std::size_t>(mesh.F(t, k))] = corners[static_cast<std::size_t>(k)];
    }
    json result = json::array();
    for (const render::Vec3& n : normals) result.push_back({n[0], n[1], n[2]});
    return result;
}

void write_cycles_job(const fs::path& file, const BenchMeshes& meshes, const CyclesJob& job,
                      const fs::path& sky) {
    json mesh_material{{"kind", job.scene.metal ? "metal" : "diffuse"},
                       {"color", numbers(mesh_color(job.scene))}};
    if (job.scene.metal) mesh_material["alpha"] = kMetalAlpha;
    json mesh = mesh_json(meshes.mesh, mesh_material);
    if (job.scene.smooth) mesh["normals"] = normals_json(meshes.mesh, make_scene(meshes, job.scene).mesh(0));
    const render::Camera camera = bench_camera();
    json text{{"meshes",
               {mesh, mesh_json(meshes.ground, {{"kind", "diffuse"}, {"color", numbers(ground_color())}})}},
              {"camera",
               {{"position", numbers(camera.position)},
                {"target", numbers(camera.target)},
                {"vertical_fov", camera.vertical_fov}}},
              {"max_scatter", kMaxScatter},
              {"width", job.width},
              {"height", job.height},
              {"spp", job.spp},
              {"seed", job.seed},
              {"threads", job.threads},
              {"output", job.output.string()}};
    if (job.scene.map) {
        text["sky"] = {{"file", sky.string()}};
    } else {
        const render::RectangleLight light = bench_light();
        text["sky"] = {{"radiance", {kSkyRadiance, kSkyRadiance, kSkyRadiance}}};
        text["light"] = {{"center", numbers(light.center.cast<double>().eval())},
                         {"target", {0, 0, 0}},
                         {"side", kLightSide},
                         {"radiance", numbers(light.radiance)}};
    }
    std::ofstream(file) << text;
}

std::string file_text(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

}  // namespace

bool cycles_is_installed() {
    return std::system("command -v blender >/dev/null 2>&1") == 0;
}

std::vector<double> run_cycles(const BenchMeshes& meshes, const std::vector<CyclesJob>& jobs,
                               const fs::path& folder) {
    const fs::path sky = fs::absolute(folder / "sky.exr"), log = fs::absolute(folder / "blender.log");
    render::write_exr(sky, bench_sky());
    std::string command =
        fmt::format("HOME='{}' blender -b --factory-startup --python-exit-code 1 --python '{}' --",
                    fs::absolute(folder).string(), AUTOMORPH_BENCH_FOLDER "/cycles_render.py");
    std::vector<fs::path> files;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        files.push_back(fs::absolute(folder / fmt::format("job_{}.json", i)));
        write_cycles_job(files.back(), meshes, jobs[i], sky);
        command += fmt::format(" '{}'", files.back().string());
    }
    if (std::system((command + " >'" + log.string() + "' 2>&1").c_str()) != 0)
        throw Error(fmt::format("Blender failed:\n{}", file_text(log)));
    std::vector<double> seconds;
    for (const fs::path& file : files) {
        seconds.push_back(std::stod(file_text(file.string() + ".seconds")));
        fs::remove(file);
        fs::remove(file.string() + ".seconds");
    }
    return seconds;
}

}  // namespace automorph::bench
