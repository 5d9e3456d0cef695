#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "morph/mesh/mesh.h"
#include "render/bsdf/material.h"
#include "render/geometry/triangle_mesh.h"
#include "render/light/rectangle_light.h"
#include "render/light/sky.h"
#include "render/light/sphere_light.h"

namespace automorph::render {

class EmbreeScene;

/// How the tree in which rays find triangles follows moved vertices. A refitted tree keeps the order of the
/// one before: it is there ten times as soon, and rays are up to 10 % slower in it. Which of two faces in one
/// place a ray meets may then depend on the frames before.
enum class TreeUpdate {
    Build,   ///< anew
    Refit,   ///< always
    Cheaper  ///< refits for pictures that take fewer rays per triangle than kRaysWorthBuilding
};

/// Above so many rays per triangle a tree built anew pays: measured by `./run bench render moving`,
/// README.md.
inline constexpr double kRaysWorthBuilding = 10.0;

struct SceneOptions {
    /// Passed to Embree's device. "isa=sse4.2" gives the same bits on every x86-64 machine (goldens need it);
    /// empty takes the best instruction set there is.
    std::string embree_config;
    TreeUpdate moved = TreeUpdate::Build;  ///< what is done after move_mesh()
};

struct MeshOptions {
    Normals normals = Normals::Smooth;
    Material material;
    /// 1: at rest during the exposure; n: move_mesh() takes the vertices at n moments from its begin to its
    /// end.
    int time_steps = 1;
    Points vertex_colors;   ///< #V x 3, linear, optional: instead of the material's base_color
    Points vertex_normals;  ///< #V x 3, optional: used instead of area-weighted ones where normals are
                            ///< Smooth; zero or not finite: none at this vertex
};

/// Everything that is rendered: meshes, lights and sky. Meshes keep their triangles while their vertices move
/// from frame to frame. Not copyable; one thread may change it at a time.
class Scene {
public:
    explicit Scene(const SceneOptions& options = {});
    ~Scene();
    Scene(Scene&&) noexcept;
    Scene& operator=(Scene&&) noexcept;

    /// Adds a mesh and returns its number. Triangles with a vertex that is not finite are invisible.
    /// @throws InvalidMesh if an index is out of range, or vertex normals are given and do not match V in
    /// number
    int add_mesh(const Points& V, const Triangles& F, const MeshOptions& options = {});

    /// Gives mesh `mesh` new vertices (#V as before); smooth normals are computed anew.
    /// @throws InvalidMesh if the number of vertices differs
    void move_mesh(int mesh, const Points& V);

    /// The same for each time step of the exposure: blurred by the motion.
    /// @throws InvalidMesh if the number of vertices or of steps differs
    void move_mesh(int mesh, const std::vector<Points>& steps);

    /// From the next move_mesh() on added to the unit normals that are computed, which are normalised again;
    /// for each time step #V x 3, none take them away.
    /// @throws InvalidMesh if the number of corrections is neither #V nor 0, or the number of steps differs
    void correct_normals(int mesh, const std::vector<Points>& steps);

    /// Whether any mesh moves during the exposure.
    bool has_motion() const;

    void set_material(int mesh, const Material& material);

    /// Gives the vertices of a mesh colours (#V x 3, linear) in place of base_color; none take them away.
    /// @throws InvalidMesh if the number of colours is neither #V nor 0
    void color_mesh(int mesh, const Points& colors);

    std::vector<RectangleLight> lights;
    std::vector<SphereLight> sphere_lights;
    Sky sky;
    std::optional<Color> background;  ///< radiance of camera rays that meet nothing; the sky's when empty

    int mesh_count() const { return static_cast<int>(meshes_.size()); }
    const TriangleMesh& mesh(int index) const { return meshes_[static_cast<std::size_t>(index)]; }
    const Material& material(int index) const { return materials_[static_cast<std::size_t>(index)]; }

    /// Brings Embree's tree up to date; render() calls it.
    /// @param rays  that will be traced in it, for TreeUpdate::Cheaper
    /// @throws Error with Embree's message when the device or the tree cannot be made
    void commit(double rays);

    const EmbreeScene& embree() const { return *embree_; }

private:
    std::vector<TriangleMesh> meshes_;
    std::vector<Material> materials_;
    std::unique_ptr<EmbreeScene> embree_;
    TreeUpdate update_;
};

}  // namespace automorph::render
