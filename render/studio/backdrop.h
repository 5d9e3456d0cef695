#pragma once

#include "render/geometry/scene.h"
#include "render/math/vec.h"

namespace automorph::render {

/// Where a floor lies: under the middle of the shape, with unit axes; lengths count in `radius`.
struct FloorPlace {
    Eigen::Vector3d below;  ///< the point under the shape
    Eigen::Vector3d right, level, up;
    double radius = 1.0;
};

struct BackdropOptions {
    Color color{0.8f, 0.8f, 0.8f};  ///< albedo of the paper
    bool squares = false;           ///< every other one is darker; they fade out with distance
    bool wall = false;              ///< the paper rises behind the shape in a quarter circle
};

/// A sheet of diffuse paper as a mesh for Scene::add_mesh.
struct Backdrop {
    Points V;
    Triangles F;
    MeshOptions options;
};
Backdrop make_backdrop(const FloorPlace& place, const BackdropOptions& options);

}  // namespace automorph::render
