#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A mesh thinned out: some of its vertices, with the borders whole.
struct CoarseMesh {
    Mesh mesh;
    std::vector<int> vertex;              ///< per coarse vertex: that of the mesh; empty: the mesh is whole
    std::vector<std::vector<int>> loops;  ///< as those of the mesh, in coarse vertices

    /// The vertex of the mesh that a coarse one is.
    int whole(int v) const { return vertex.empty() ? v : vertex[static_cast<std::size_t>(v)]; }
};

/// Thins a mesh out to about so many vertices by half-edge collapses (decimation.h). All border vertices
/// stay.
/// @param loops  as from boundary_loops
CoarseMesh coarse_mesh(const Mesh& mesh, const std::vector<std::vector<int>>& loops, int vertices);

/// Carries a motion of the coarse mesh over to points near it. Each goes with the closest point of the coarse
/// mesh at rest, moved as the neighbourhoods of its corners are: blended affine motions fitted to the
/// corners' edges and normals, so that what lies beside the coarse surface keeps its place beside it.
/// @param rest     the coarse mesh before the motion
/// @param moved    #rest x 3, after it
/// @param points   #n x 3, before the motion, with normals (unit or zero)
Points carried(const Mesh& rest, const Points& moved, const Points& points, const Points& normals);

}  // namespace automorph
