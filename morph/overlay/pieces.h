#pragma once

#include <vector>

#include "morph/overlay/trace.h"

namespace automorph {

/// A piece of an edge between merged vertices, and the triangles of the other map on either side of it: one
/// and the same unless it runs along an edge there; -1 outside the border.
struct Piece {
    int left, right;
    int from, to;
};

/// The pieces of all edges of a map, in the order and direction in which the edges were walked.
struct EdgePieces {
    struct Edge {
        int halfedge = -1;       ///< in the direction of travel
        int begin = 0, end = 0;  ///< range in `pieces`
    };
    std::vector<Edge> edges;
    std::vector<Piece> pieces;
};

/// An edge of b crosses an edge of a.
struct Crossing {
    int eb;      ///< half-edge of b whose triangle is entered when ea is walked in the direction of
                 ///< HalfEdgeTable::edge
    int vertex;  ///< merged
};

/// What the walks of b's edges say about a.
struct CrossingsOfA {
    std::vector<Crossing> crossings;  ///< those of one edge of a together
    std::vector<int> first;           ///< #half-edges of a + 1: range of an edge, at HalfEdgeTable::edge
    std::vector<char>
        touched;  ///< per half-edge of a, at HalfEdgeTable::edge: a vertex of b lies inside the edge
    std::vector<Place> place;  ///< per vertex of a: where it lies in b, if on a vertex or an edge
};

/// The pieces of a's edges. Crossings are put in order without arithmetic: each leaves one triangle of b and
/// enters another, and an edge meets a triangle once. Only edges that touch vertices or edges of b without
/// crossing any are walked by exact signs.
/// @param vertex_of_b  per vertex of b: its merged vertex; vertices of a are merged vertices themselves
/// @param seed         vertex of a whose place is known
/// @param known        completed: the places of all vertices of a
/// @throws SolverFailure if the crossings do not line up: the maps are not one-to-one
EdgePieces pieces_of_a(const MapView& a, const MapView& b, const std::vector<int>& vertex_of_b, int seed,
                       CrossingsOfA& known);

}  // namespace automorph
