#pragma once

#include <string>
#include <vector>

#include "morph/mesh/mesh.h"
#include "render/camera/camera.h"
#include "render/film/image.h"
#include "render/geometry/scene.h"

namespace automorph::bench {

/// The mesh in the unit ball about the centre of its box, and the ground it stands on. Z is up.
struct BenchMeshes {
    Mesh mesh, ground;
};

/// @throws IoError, InvalidMesh
BenchMeshes read_bench_meshes(const std::string& file);

/// What is lit and how. The ground is diffuse and reflects half.
struct BenchScene {
    std::string name;     ///< "S1", ...
    bool smooth = false;  ///< normals
    bool metal = false;   ///< GGX of kMetalAlpha and constant reflectance, else diffuse
    bool map = false;     ///< light from bench_sky() alone, else from a square and a faint constant sky
};

inline constexpr float kMetalAlpha = 0.2f;
inline constexpr int kMaxScatter = 6;

/// S1 diffuse, S1s with smooth normals, S2 metal, S3 under the sky map.
const std::vector<BenchScene>& bench_scenes();

render::Color mesh_color(const BenchScene& scene);  ///< albedo, or reflectance of metal
render::Color ground_color();                       ///< albedo
render::RectangleLight bench_light();               ///< a square
inline constexpr float kLightSide = 1.0f;           ///< scene units; it faces the origin
inline constexpr float kSkyRadiance = 0.1f;         ///< beside the square
render::Camera bench_camera();

/// day_sky() of the tests, made once.
const render::Image& bench_sky();

/// A torus about the z-axis, of two triangles per cell.
Mesh torus(int around, int across);

render::Scene make_scene(const BenchMeshes& meshes, const BenchScene& scene);

}  // namespace automorph::bench
