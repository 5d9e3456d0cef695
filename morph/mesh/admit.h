#pragma once

#include <string>
#include <vector>

#include "morph/mesh/io.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// What a soup holds, counted before and after mending. METHOD: "Openings, heads, bad input".
struct MeshInspection {
    int vertices = 0, polygons = 0, triangles = 0;
    int components = 0;            ///< of the triangles, by shared edges
    int boundary_loops = 0;
    int euler_characteristic = 0;  ///< V - E + F of what is admitted
    int genus = 0;
    int non_manifold_edges = 0, non_manifold_vertices = 0;
    int degenerate_triangles = 0;  ///< repeated corner; zero-area triangles stay (they are needed for closure)
    int duplicate_vertices = 0, unused_vertices = 0;
    int inconsistent_edges = 0;    ///< both triangles run through the edge in the same direction
    bool closed = false;
};

/// An admissible mesh: one component, manifold, orientable, genus 0, finite coordinates, positive area;
/// closed meshes face outwards.
struct AdmittedMesh {
    Mesh mesh;
    std::vector<int> vertex_of_file;       ///< per file vertex: its vertex in `mesh`, or -1 if unused / dropped
    MeshInspection found;                  ///< before mending
    MeshInspection admitted;               ///< after mending
    std::vector<std::string> mended;       ///< one sentence per mending, e.g. "merged 424 duplicate vertices"
};

/// Counts without changing anything and never throws on bad topology.
MeshInspection inspect(const PolygonSoup& soup);

/// Mends what can be mended (duplicate vertices as in STL, but only where the soup is not already manifold;
/// polygons, unused vertices, degenerate triangles, flipped triangles and components, a few stray triangles)
/// and refuses the rest.
/// @param name  how errors call the mesh, e.g. its file name
/// @throws InvalidMesh  what was found, where (vertex or triangle index), and what to do
AdmittedMesh admit(const PolygonSoup& soup, const std::string& name);

}  // namespace automorph
