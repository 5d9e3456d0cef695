#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Half-edges of a closed triangle mesh in flat arrays, made to be thinned out and restored: half-edge 4 f +
/// k runs from corner k of triangle f to its next corner (4 f + 3 is not used). A collapse overwrites nothing
/// but what undo() can restore from the half-edge alone, so that the history is one number per collapse.
struct HalfEdges {
    std::vector<int> origin;    ///< 4 #F: vertex a half-edge starts at
    std::vector<int> opposite;  ///< 4 #F: the half-edge that runs the other way
    std::vector<int> out;       ///< #V: one of the half-edges that start at a vertex
    std::vector<int> valence;   ///< #V

    static int next(int h) { return (h & 3) == 2 ? h - 2 : h + 1; }
    static int prev(int h) { return (h & 3) == 0 ? h + 2 : h - 1; }
    static int triangle(int h) { return h >> 2; }
    int target(int h) const { return origin[static_cast<std::size_t>(next(h))]; }
    int twin(int h) const { return opposite[static_cast<std::size_t>(h)]; }
    /// The next half-edge counter-clockwise about the origin of h.
    int turn(int h) const { return twin(prev(h)); }

    /// Moves the origin v of h onto its target u: both triangles at h go, those left at v get the corner u.
    /// @pre u and v have exactly two common neighbours, the mesh more than 4 vertices
    void collapse(int h);
    /// Takes the latest collapse that is not undone back.
    void undo(int h);
};

/// @throws InvalidMesh  an edge does not have two triangles that run through it in opposite directions
HalfEdges half_edges(const Triangles& F, int vertex_count);

}  // namespace automorph
