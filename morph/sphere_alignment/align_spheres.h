#pragma once

#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/sphere_alignment/surface_matches.h"

namespace automorph {

/// A mesh and its map onto the sphere.
struct MappedMesh {
    const Mesh& mesh;
    const std::vector<int>& loop;  ///< locked border; empty for a closed mesh
    Points rays;                   ///< #V x 3, unit vectors
};

/// Two maps onto the sphere brought together.
struct AlignedSpheres {
    Points rays_a, rays_b;  ///< unit vectors; all triangles positive
    int matches = 0;        ///< pairs of surface points that were used
    double before = 0.0;    ///< weighted mean angle between matched points, radians, before the alignment,
    double rotated = 0.0;   ///< after the rotation,
    double after = 0.0;     ///< and after the warp
};

/// Brings the maps of two shapes together on the sphere, so that matched points meet.
///
/// Rotation  by SVD of sum p s_a s_b^T over the matches [Kabsch76]; b is turned. With a locked border there
/// is
///           none: the common border ties the maps.
/// Warp      both maps towards their mean along a smooth tangent field, from wide to narrow (kWidest ..
/// kNarrowest),
///           each move guarded per vertex (guarded_move.h), with relaxing sweeps (sphere_relaxation.h).
///           Border vertices stay.
/// @throws SolverFailure  a triangle has lost its orientation, with counts
AlignedSpheres align_spheres(const MappedMesh& a, const MappedMesh& b, const SurfaceMatches& matches);

}  // namespace automorph
