#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>

#include "morph/mesh/mesh.h"
#include "morph/shapes/implicit.h"

namespace automorph {

struct RemeshOptions {
    int triangles = 8000;    ///< of the result; made even, at least 4
    std::uint64_t seed = 1;  ///< every seed gives another tessellation
    /// Wanted edge length at a point relative to other points: positive, smooth, changing by less than a
    /// third from an edge to the next. Empty: the same everywhere.
    std::function<double(const Eigen::Vector3d&)> spacing;
};

/// Tessellates a closed implicit surface into even, nearly equilateral triangles of one size, or of
/// sizes as `spacing` asks for.
///
/// Method     [Botsch04]: split long edges, collapse short ones, flip, relax in the tangent plane towards the
///            area-weighted centroid of each vertex' triangles, project. Then the seed comes in: vertices are
///            shaken by more than an edge length, so that no pattern of `start` is left. The count is made
///            exact, and some rounds of flips and relaxation make the triangles even.
/// Deviation  flips make the triangulation Delaunay instead of the valences 6: better triangles, fewer
/// rounds. Result     vertices on the surface (to rounding), closed, of the topology of `start`, facing
/// outwards.
///            The triangle count is exact unless the shape is too thin for so few triangles.
/// Cost       linear in the triangles of `start` and of the result.
/// @pre `start` is closed, faces outwards, has no folds and lies so near the surface that projecting it along
/// the
///      gradient keeps it so
/// @throws InvalidMesh   `start` is not a closed manifold
/// @throws SolverFailure a point could not be projected to the surface
Mesh remesh(const Mesh& start, const ImplicitSurface& surface, const RemeshOptions& options = {});

}  // namespace automorph
