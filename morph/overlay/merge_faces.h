#pragma once

#include "morph/overlay/overlay.h"
#include "morph/overlay/pieces.h"

namespace automorph {

/// Convex merged faces from the pieces of all edges of two maps, filed by triangle of a.
struct MergedFaces {
    std::vector<int> polygon_start, polygon_vertices;  ///< as in Overlay
    std::vector<int> face_of_a, face_of_b;
};

/// Every merged face is the intersection of one triangle fa with one triangle fb, hence convex and connected.
/// So no angular sorting is needed: each piece of an edge knows the pair (fa, fb) on its left, and the pieces
/// with the same pair are the sides of one merged face. Linear in the result.
/// @throws SolverFailure if the sides of a face do not close
MergedFaces merge_faces(const HalfEdgeTable& a, const EdgePieces& of_a, const HalfEdgeTable& b,
                        const EdgePieces& of_b);

}  // namespace automorph
