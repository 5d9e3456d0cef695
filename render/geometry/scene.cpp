#include "render/geometry/scene.h"

#include <algorithm>

#include "render/geometry/embree_scene.h"

namespace automorph::render {

Scene::Scene(const SceneOptions& options)
    : embree_(std::make_unique<EmbreeScene>(options.embree_config)), update_(options.moved) {}
Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

int Scene::add_mesh(const Points& V, const Triangles& F, const MeshOptions& options) {
    const int id = mesh_count();
    meshes_.emplace_back(V, F, options.normals, options.vertex_normals, options.time_steps);
    try {
        meshes_.back().color(options.vertex_colors);
    } catch (...) {
        meshes_.pop_back();
        throw;
    }
    materials_.push_back(options.material);
    embree_->attach(static_cast<std::uint32_t>(id), meshes_.back());
    return id;
}

void Scene::move_mesh(int mesh, const Points& V) {
    TriangleMesh& moved = meshes_[static_cast<std::size_t>(mesh)];
    moved.move(std::vector<Points>(static_cast<std::size_t>(moved.time_steps()), V));
    embree_->moved(static_cast<std::uint32_t>(mesh));
}

void Scene::move_mesh(int mesh, const std::vector<Points>& steps) {
    meshes_[static_cast<std::size_t>(mesh)].move(steps);
    embree_->moved(static_cast<std::uint32_t>(mesh));
}

void Scene::correct_normals(int mesh, const std::vector<Points>& steps) {
    meshes_[static_cast<std::size_t>(mesh)].correct_normals(steps);
}

bool Scene::has_motion() const {
    return std::any_of(meshes_.begin(), meshes_.end(),
                       [](const TriangleMesh& mesh) { return mesh.time_steps() > 1; });
}

void Scene::color_mesh(int mesh, const Points& colors) {
    meshes_[static_cast<std::size_t>(mesh)].color(colors);
}

void Scene::set_material(int mesh, const Material& material) {
    materials_[static_cast<std::size_t>(mesh)] = material;
}

void Scene::commit(double rays) {
    double triangles = 0.0;
    for (const TriangleMesh& mesh : meshes_) triangles += mesh.triangle_count();
    const bool few = rays < kRaysWorthBuilding * triangles;
    embree_->commit({.refit = update_ == TreeUpdate::Refit || (update_ == TreeUpdate::Cheaper && few)});
}

}  // namespace automorph::render
