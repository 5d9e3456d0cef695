#pragma once

#include <vector>

#include "morph/exact/predicates.h"
#include "morph/mesh/half_edge_table.h"

namespace automorph {

/// A map as the tracer sees it: connectivity and one ray per vertex.
struct MapView {
    const HalfEdgeTable& half_edges;
    const Points& rays;

    Ray ray(int vertex) const { return rays.row(vertex); }
};

/// Where a point lies in a map: on a vertex, inside an edge, or inside a triangle.
struct Place {
    enum class On : char { Vertex, Edge, Face };
    On on = On::Vertex;
    int index = -1;  ///< vertex, half-edge, triangle; -1: not known

    bool known() const { return index >= 0; }
    friend bool operator==(const Place&, const Place&) = default;
};

/// One piece of a traced segment: it runs through the inside of a triangle (left == right), or along an edge,
/// up to `stop`.
struct Stretch {
    int left, right;  ///< triangles on either side, -1 outside the border
    Place stop;  ///< a vertex met, an edge crossed (the half-edge of the triangle left), or the segment's end
};

/// Every edge of one map walked through the other.
struct EdgeTraces {
    struct Trace {
        int halfedge;    ///< of the traced map, in the direction of travel
        int begin, end;  ///< range in `stretches`
    };
    std::vector<Trace> traces;  ///< one per edge
    std::vector<Stretch> stretches;
    std::vector<Place>
        place;  ///< per vertex of the traced map: where it lies in the other; edges by HalfEdgeTable::edge
};

/// The place of a point in a map by testing every triangle: exact, O(#F).
/// @throws SolverFailure if no triangle contains it
Place locate(const MapView& map, const Ray& point);

/// Walks p -> q through a map by exact signs of det[a b c], appends its stretches to `out`, returns the place
/// of q.
/// @param start  place of p
/// @param end    place of q if known: spares tests where it is in a triangle
/// @throws SolverFailure if the walk leaves the map
Place walk(const MapView& map, const Ray& p, const Ray& q, Place start, Place end, std::vector<Stretch>& out);

/// Walks every edge of `traced` through `through`, starting from one vertex of known place and following
/// edges from there.
/// @throws SolverFailure if a trace leaves `through`: the maps do not cover the same domain
EdgeTraces trace_edges(const MapView& traced, const MapView& through, int seed_vertex, Place seed_place);

}  // namespace automorph
