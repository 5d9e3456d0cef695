#pragma once

#include <array>

#include "morph/mesh/mesh.h"
#include "render/camera/camera.h"

/// Small changes of a scene that a comparison has to see, and what they are made of.
namespace power {

enum class Change {
    None,
    Light,         ///< lamps 2 % brighter
    Albedo,        ///< base colour of the body 1 % brighter
    Normal,        ///< one vertex normal turned round
    DarkTriangle,  ///< one triangle with half the base colour
    Ring,          ///< the triangles about one vertex removed
    Camera         ///< turned by 0.1 degrees
};
constexpr std::array<Change, 6> kChanges{Change::Light,        Change::Albedo, Change::Normal,
                                         Change::DarkTriangle, Change::Ring,   Change::Camera};
const char* name(Change change);

/// Those that do not touch the vertex.
automorph::Triangles without_ring(const automorph::Triangles& F, int vertex);

/// Turned about its upward direction.
automorph::render::Camera turned(automorph::render::Camera camera, double degrees);

}  // namespace power
