#pragma once

#include <vector>

#include "morph/parameterization/half_edges.h"

namespace automorph {

/// Thins a closed mesh out to its base by half-edge collapses, cheapest first.
///
/// Method     quadric error of the vertex that goes [Garland97], plus a share of edge length and area, so
/// that flat
///            parts thin out evenly; penalties for triangles that turn over and for high valence. A collapse
///            needs exactly two common neighbours (link condition).
/// Order      (cost, vertex index); costs are brought up to date when a vertex comes to the top.
/// @param mesh    is left thinned out
/// @param V       #V x 3, scaled to an area of about 4 pi
/// @param fixed   #V: vertices that stay (a border and the apex that closes it), or empty
/// @param leave   stops when so many of the vertices that may go are left; 0: goes on to the base
/// @returns the collapses in their order: for HalfEdges::undo. All vertices but 4 go, or with a border all
/// that
///          are not fixed but one.
/// @pre with a border: no edge joins two border vertices across the inside
/// @throws SolverFailure  no collapse is left before the base; with `leave` that is an end like any other
std::vector<int> decimate(HalfEdges& mesh, const Points& V, const std::vector<char>& fixed, int leave = 0);

}  // namespace automorph
