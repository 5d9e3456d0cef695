#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A point of a mesh: vertex corners[0] (count 1), a point of an edge (2), or of a triangle (3), as positive
/// weights that sum to 1. Weights come from the map: they place the same point on the surface.
struct Site {
    int corners[3] = {-1, -1, -1};
    double weights[3] = {0, 0, 0};
    int count = 0;
};

inline Site site_of_vertex(int v) {
    return {{v, -1, -1}, {1.0, 0.0, 0.0}, 1};
}

/// The common refinement of two maps of the same domain, [Kent92], [Urtasun04] Sec. 3 and 4.4.
struct Overlay {
    std::vector<Site> on_a, on_b;  ///< per merged vertex: where it lies on either mesh
    std::vector<int> vertex_of_a;  ///< per vertex of a: its merged vertex
    std::vector<int> vertex_of_b;
    std::vector<int>
        polygon_start;  ///< convex merged faces, counter-clockwise: offsets into polygon_vertices
    std::vector<int> polygon_vertices;
    std::vector<int> face_of_a, face_of_b;  ///< per merged face: the triangle of a, of b, that contains it
    int crossings = 0;                      ///< I_tot: proper edge-edge crossings
    int coincident = 0;                     ///< vertices of a and b at one place, border included
    int on_edges = 0;                       ///< vertices of one map on an edge of the other

    int vertex_count() const { return static_cast<int>(on_a.size()); }
    int face_count() const { return static_cast<int>(face_of_a.size()); }
};

/// Overlays two valid maps. All topology is decided by exact signs of det[a b c] on the given rays;
/// degenerate cases (vertex on vertex, vertex on edge, overlapping edges) included. Merged faces are strictly
/// convex with at most six corners. Cost is linear in the size of the result, after one point location.
/// @pre both maps are one-to-one (orientation > 0 everywhere) and cover the same domain: the same border
/// polygon,
///      identical doubles, or the whole sphere
/// @throws SolverFailure if the maps do not cover the same domain
Overlay overlay(const Mesh& a, const Points& rays_a, const Mesh& b, const Points& rays_b);

}  // namespace automorph
