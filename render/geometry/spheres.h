#pragma once

#include "morph/mesh/mesh.h"

namespace automorph::render {

/// One small sphere, as a mesh whose vertices move with its centre.
struct Sphere {
    Points directions;    ///< #n x 3, unit: vertices from the centre, and normals
    Triangles triangles;  ///< #m x 3
};

/// The sphere that markers are made of: an octahedron, its faces split into squares of `steps`, 8 steps^2
/// triangles.
Sphere make_sphere(int steps = 8);

/// Vertices of spheres about points (#c x 3), sphere by sphere: #c * #n x 3.
Points sphere_vertices(const Sphere& sphere, const Points& centers, double radius);

/// Their triangles.
Triangles sphere_triangles(const Sphere& sphere, int count);

}  // namespace automorph::render
