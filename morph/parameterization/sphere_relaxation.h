#pragma once

#include <vector>

#include "morph/parameterization/half_edges.h"
#include "morph/parameterization/sphere_energy.h"

namespace automorph {

/// A valid map of a closed mesh onto the sphere that is made better vertex by vertex, and of which vertices
/// may be taken or put back (half_edges.h). Every move keeps all triangles about the vertex positive, hence
/// the map valid.
class SphereRelaxation {
public:
    /// @param V      #V x 3, any unit
    /// @param fixed  #V: vertices that never move (a border and the apex that closes it), or empty. Triangles
    /// with an
    ///               apex are no part of the surface; no vertex that moves may touch one
    /// @param domain solid angle of the surface's share of the sphere
    SphereRelaxation(HalfEdges mesh, const Points& V, std::vector<char> fixed, double domain);

    HalfEdges mesh;
    Points rays;  ///< #V x 3, unit vectors; rows of vertices that are not in the mesh have no meaning

    /// Measures the triangles in the mesh anew, scaled such that their areas sum to the domain. Call after
    /// the number of vertices has changed a good deal, or `rays` were changed from outside.
    /// @param triangles  those in the mesh
    /// @param surface    those that count for the area
    void measure(const std::vector<int>& triangles);
    /// Measures one triangle in the scale of the last measure().
    void measure_triangle(int triangle);

    /// Puts the origin of an undone collapse's half-edge on the sphere: near the vertex it had gone to, where
    /// it sees all its neighbours, or at their mean, whichever has the lower energy. Its triangles must have
    /// been measured.
    /// @returns false if no valid place was found in doubles
    bool insert(int vertex);

    /// One step for one vertex, if that lowers the energy by something to speak of. Returns the decrease.
    double relax(int vertex);

    /// relax() for each of the vertices whose surroundings have changed since they last came to rest, in
    /// order. Returns the decrease relative to the energy of an isometry.
    double sweep(const std::vector<int>& vertices);
    /// sweep() until the relative decrease is below kSettled, at most `most` times.
    void sweep(const std::vector<int>& vertices, int most);
    /// All vertices count as changed.
    void wake();

private:
    void gather(int vertex);
    void wake_star(int vertex);
    bool is_fixed(int vertex) const {
        return !fixed_.empty() && fixed_[static_cast<std::size_t>(vertex)] != 0;
    }

    Points V_;
    std::vector<char> fixed_, awake_;
    double domain_, scale_ = 1.0, eps_ = 0.0;  ///< scale_ of lengths
    std::vector<TriangleMetric> metric_;
    SphereStar star_;
};

/// Relative decrease of the energy by one sweep at which a map counts as relaxed.
constexpr double kSettled = 2e-4;

}  // namespace automorph
