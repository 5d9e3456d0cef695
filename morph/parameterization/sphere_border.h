#pragma once

#include <array>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

// What an open pair needs to be mapped onto the sphere with its common border locked on a circle of latitude.

/// Share that a flat cap on the border (a fan about the mean of its vertices) would have in the area of the
/// capped mesh, 0..1: small where a short border closes a large shape.
double cap_share(const Mesh& mesh, const std::vector<int>& loop);

/// Height z of the circle: -(1 - 2 c), at which the cap below it has the share c of the sphere; c is the mean
/// of both meshes' cap shares, kept in [0.002, 0.5].
double locked_height(double share_a, double share_b);

/// Unit rays at longitudes `angles` (radians, increasing) and height z in (-1, 0], #angles x 3.
Points locked_border(const Eigen::VectorXd& angles, double z);

/// A mesh whose inner edges do not join two border vertices.
struct ChordFreeMesh {
    Mesh mesh;  ///< input vertices and triangles keep their indices (a split triangle
                ///< is its first part); new ones follow
    std::vector<std::array<int, 2>> midpoint;  ///< vertex (input count + k) is halfway between these two
};

/// Splits inner edges between border vertices in the middle: on the sphere such an edge would run outside of
/// the border's circle. The surface stays the same.
ChordFreeMesh split_chords(const Mesh& mesh, const std::vector<int>& loop);

/// A mesh closed for half-edges: its border, if it has one, joined to an apex by a fan.
struct ClosedMesh {
    Mesh mesh;                ///< vertices and triangles of the input, then the apex and its fan
    std::vector<char> fixed;  ///< #V: border vertices and the apex; empty without border
    int surface = 0;          ///< triangles of the input
};

/// @param loop  the only boundary loop, or empty for a closed mesh
ClosedMesh closed_with_apex(const Mesh& mesh, const std::vector<int>& loop);

}  // namespace automorph
