#pragma once

#include <vector>

#include "morph/exact/predicates.h"
#include "morph/mesh/connectivity.h"

namespace automorph {

/// A map as the tracer sees it: connectivity and one ray per vertex.
struct MapView {
    const Connectivity& topology;
    const Points& rays;

    Ray ray(int vertex) const { return rays.row(vertex); }
};

/// Where a point lies in a map: on a vertex, inside an edge, or inside a triangle.
struct Place {
    enum class On : char { Vertex, Edge, Face };
    On on = On::Vertex;
    int index = -1;

    friend bool operator==(const Place&, const Place&) = default;
};

/// One piece of a traced segment: it runs through the inside of a triangle, or along a half-edge, up to
/// `stop`.
struct Stretch {
    int carrier;  ///< triangle; or the half-edge in the direction of travel if `along`
    bool along;
    Place stop;  ///< a vertex met, an edge crossed, or the place of the segment's end
};

/// Every edge of one map walked through the other.
struct EdgeTraces {
    struct Trace {
        int halfedge = -1;       ///< of the traced map, in the direction of travel
        int begin = 0, end = 0;  ///< range in `stretches`
    };
    std::vector<Trace> of_edge;  ///< per edge
    std::vector<Stretch> stretches;
    std::vector<Place> place;  ///< per vertex of the traced map: where it lies in the other
};

/// The place of a point in a map by testing every triangle: exact, O(#F).
/// @throws SolverFailure if no triangle contains it
Place locate(const MapView& map, const Ray& point);

/// Walks every edge of `traced` through `through`, starting from one vertex of known place and following
/// edges from there. All decisions are exact signs of det[a b c].
/// @throws SolverFailure if a trace leaves `through`: the maps do not cover the same domain
EdgeTraces trace_edges(const MapView& traced, const MapView& through, int seed_vertex, Place seed_place);

}  // namespace automorph
