#pragma once

#include <string>
#include <vector>

#include "morph/mesh/admit.h"
#include "morph/mesh/edges.h"

namespace automorph {

/// A mesh on its way to admission. Steps change it in place and add a sentence to `mended` for what they did.
struct Draft {
    Points V;
    Triangles F;
    std::vector<int> polygon;         ///< per triangle: its polygon in the file
    std::vector<int> file_vertex;     ///< per vertex: a vertex of the file at its place
    std::vector<int> vertex_of_file;  ///< per file vertex: its vertex here, or -1
    std::vector<std::string> mended;
};

/// Vertices at the same place, bit for bit (but -0 is 0).
Labels coincident_vertices(const Points& V);

/// Merges vertices at the same place.
void merge_coincident_vertices(Draft& draft);

/// Drops triangles that repeat a corner or have the corners of an earlier one.
void drop_degenerate_and_duplicate_triangles(Draft& draft);

/// Drops small components beside a large one, and small patches that hang on an edge of three or more
/// triangles.
void drop_strays(Draft& draft);

/// Turns triangles until neighbours agree.
/// @throws InvalidMesh for a Moebius strip
void orient(Draft& draft, const std::string& name);

/// Gives every umbrella of triangles around a vertex its own vertex.
void split_vertices(Draft& draft);

/// Drops vertices that no triangle uses.
void drop_unused_vertices(Draft& draft);

/// Turns a closed mesh that faces inwards.
void turn_outwards(Draft& draft);

/// The counts that inspect() gives, of triangles that repeat no corner.
MeshInspection inspect_triangles(const Points& V, const Triangles& F);

}  // namespace automorph
