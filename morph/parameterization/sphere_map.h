#pragma once

#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/parameterization/map_quality.h"

namespace automorph {

/// A one-to-one map onto the unit sphere, or onto what a border of it encloses.
struct SphereMap {
    Points rays;             ///< #V x 3, unit vectors; border vertices as given
    MapQuality quality;      ///< `flipped` is 0
    double solid_angle = 0;  ///< sum over the triangles: 4 pi, or what is on the inner side of the border
};

/// Progressive spherical embedding [Praun03] of a closed genus-0 mesh.
///
/// Method     down: half-edge collapses to a tetrahedron (decimation.h). Up: each vertex comes back where it
/// sees all
///            its neighbours, then it and its ring are relaxed; whenever the mesh has grown by kGrowth, all
///            of it (sphere_relaxation.h; energy: sphere_energy.h). No step turns a triangle, at any size of
///            triangle.
/// Check      exact signs of all triangles; the solid angles add to 4 pi, so that the sphere is covered once.
/// Cost       O(n log n); two maps may be computed at once. Deterministic; depends on numbering and pose of
/// the mesh
///            only by rounding and ties.
/// @throws InvalidMesh    not closed, or without area
/// @throws SolverFailure  the check fails, with counts
SphereMap sphere_map(const Mesh& mesh);

/// The same for an open mesh, with its border at given rays on a circle of latitude z <= 0 in increasing
/// longitude; the mesh goes to the side of the north pole.
/// @param loop    the only boundary loop; no edge joins two of its vertices across the mesh (split_chords)
/// @param border  #loop x 3 unit vectors, neighbours less than pi apart (locked_border)
SphereMap sphere_map(const Mesh& mesh, const std::vector<int>& loop, const Points& border);

}  // namespace automorph
