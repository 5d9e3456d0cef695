#pragma once

#include <vector>

#include "morph/mesh/half_edge_table.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// Discrete curvatures of the vertices of a surface, free of scale: equal on a shape and its enlarged copy.
struct Curvature {
    Eigen::VectorXd gaussian;   ///< #V: K times the area of the surface; 4 pi on every sphere
    Eigen::VectorXd mean;       ///< #V: H times the root of the area; positive where the surface is convex
    std::vector<char> defined;  ///< #V: the vertex is inner and has area; elsewhere both curvatures are 0

    bool operator[](int v) const { return defined[static_cast<std::size_t>(v)] != 0; }
};

/// Gauss-Bonnet scheme [Surazhsky03], [Urtasun04] Sec. 4.3:
/// K_i = (2 pi - sum of angles) / (A_i / 3), H_i = (1/4 sum |e| beta_e) / (A_i / 3), with A_i the area of the
/// triangles around i and beta_e the angle between the normals at edge e, negative at a valley.
/// The sum of K_i A_i / 3 is exactly 2 pi chi on a closed mesh. Both converge to the curvatures of a smooth
/// surface at vertices of valence 6 in a regular neighbourhood; elsewhere in the mean.
/// @param half_edges  of mesh
Curvature curvature(const Mesh& mesh, const HalfEdgeTable& half_edges);

/// Curvatures as a scan shows them at a coarser scale: both are spread by heat flow over the surface, one
/// implicit step of the cotangent Laplacian, which keeps their sums over the surface. "Beyond": the paper
/// takes them as they are.
/// @param length  width of the kernel (standard deviation along a line), relative to the root of the area
/// @throws SolverFailure  the factorisation failed
Curvature smoothed(const Curvature& curvature, const Mesh& mesh, double length);

}  // namespace automorph
