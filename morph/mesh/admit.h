#pragma once

#include <string>
#include <vector>

#include "morph/mesh/io.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// What a soup holds, counted on its triangles (polygons split) before or after mending.
/// METHOD: "Openings, heads, bad input".
struct MeshInspection {
    int vertices = 0, polygons = 0, triangles = 0;
    int components = 0;  ///< of the triangles, by edges that two triangles share
    int boundary_loops = 0, boundary_edges = 0;
    int euler_characteristic = 0;  ///< V - E + F, without unused vertices
    int genus = 0;  ///< handles, summed over the components; -1 if not manifold or not orientable
    int non_manifold_edges = 0;     ///< more than two triangles
    int non_manifold_vertices = 0;  ///< triangles that touch at the vertex without sharing an edge there
    int degenerate_triangles = 0;   ///< repeated corner, not counted as triangles; zero area is no defect
    int duplicate_vertices = 0;     ///< vertices at the very place of an earlier one
    int unused_vertices = 0;
    int inconsistent_edges = 0;  ///< both triangles run through the edge in the same direction
    bool orientable = true;      ///< false: a Moebius strip
    bool closed = false;         ///< every edge has two triangles
};

/// An admissible mesh: one component, manifold, orientable, genus 0, finite coordinates, positive area;
/// closed meshes face outwards.
struct AdmittedMesh {
    Mesh mesh;
    std::vector<int> vertex_of_file;  ///< per file vertex: its vertex in `mesh`, or -1 if unused / dropped
    MeshInspection found;             ///< before mending
    MeshInspection admitted;          ///< after mending
    std::vector<std::string> mended;  ///< one sentence per mending, e.g. "merged 424 duplicate vertices"
};

/// Counts without changing anything; any topology is accepted. Indices must be within range, as read_mesh
/// leaves them.
MeshInspection inspect(const PolygonSoup& soup);

/// Mends what can be mended (duplicate vertices as in STL, but only where the soup is not already manifold;
/// polygons, unused vertices, degenerate triangles, flipped triangles and components, a few stray triangles)
/// and refuses the rest.
/// @param name  how errors call the mesh, e.g. its file name
/// @throws InvalidMesh  what was found, where (vertex or triangle index), and what to do
AdmittedMesh admit(const PolygonSoup& soup, const std::string& name);

}  // namespace automorph
