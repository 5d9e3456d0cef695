#pragma once

#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Half-edge connectivity of a triangle mesh, without geometry. Vertex and face handles carry the indices of
/// Mesh::V and Mesh::F; edge e owns the half-edges 2e and 2e + 1.
using Connectivity = OpenMesh::TriConnectivity;

/// Builds the half-edge structure of a manifold, consistently oriented mesh.
/// @throws InvalidMesh if a triangle cannot be added (non-manifold edge or vertex, inconsistent orientation);
///         the message names the triangle.
Connectivity connectivity(const Triangles& F, int vertex_count);

/// Boundary loops as vertex cycles, each with the surface on its left (the direction of the triangles at the
/// border), longest first by 3D length; a loop starts at its vertex of smallest index.
std::vector<std::vector<int>> boundary_loops(const Mesh& mesh, const Connectivity& topology);
std::vector<std::vector<int>> boundary_loops(const Mesh& mesh);

/// V - E + F.
int euler_characteristic(const Connectivity& topology);

}  // namespace automorph
