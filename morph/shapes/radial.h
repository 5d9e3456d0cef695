#pragma once

#include "morph/mesh/mesh.h"
#include "morph/shapes/implicit.h"
#include "morph/shapes/shapes.h"

namespace automorph {

/// A mesh of a surface that every ray from the origin meets once, within `radius`: a subdivided icosahedron
/// in a random orientation (by `seed`), moved out along its rays. A start for remesh().
/// @throws SolverFailure if the field is not negative at the origin and positive at `radius` along a ray
Mesh radial_mesh(const ImplicitSurface& surface, double radius, std::uint64_t seed);

/// The mesh in the pose that the options say.
Mesh posed(Mesh mesh, const ShapeOptions& options);

/// radial_mesh(), remeshed and posed as the options say.
Mesh radial_shape(const ImplicitSurface& surface, double radius, const ShapeOptions& options);

}  // namespace automorph
