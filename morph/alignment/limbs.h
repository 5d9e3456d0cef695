#pragma once

#include <Eigen/Core>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A part of a surface that sticks out: an arm, a leg, a finger, a horn, a tail.
struct Limb {
    int tip = 0;          ///< vertex
    double length = 0.0;  ///< along the surface from the tip to where the limb widens into the rest
    double reach = 0.0;   ///< mean distance of the tip from the surface beyond that of the surface's centre
    Eigen::VectorXd from_tip;  ///< #V, distances along the surface
    Points axis;  ///< #n x 3, middles of the rings about the tip, `step` apart; the first is the tip
    double step = 0.0;

    /// The middle of the limb at a distance from its tip, between 0 and `length`; and which way it goes on.
    Eigen::RowVector3d middle(double distance) const;
    Eigen::RowVector3d direction(double distance) const;
};

struct Limbs {
    std::vector<Limb> limbs;  ///< those that reach farthest first
    double size = 0.0;        ///< of the surface: the mean distance along it between two of its points
};

/// The limbs of a surface. Lengths are in the mesh's unit.
///
/// Method  tips are the maxima of the mean distance along the surface, with little surface about them: within
/// a
///         quarter of the root of the area less than half of a flat disk of that radius. Of tips closer
///         together than `kApart` the farthest counts. Beyond the paper: where curvature says little, as on
///         the end of an arm, distance says what belongs together.
/// @param loops  as from boundary_loops: what ends at a border is no tip
Limbs find_limbs(const Mesh& mesh, const std::vector<std::vector<int>>& loops);

/// Two limbs taken for the same, as indices.
struct LimbMatch {
    int source, target;
};

/// Limbs of two registered surfaces that belong together: near one another in place and in how far they
/// reach, as long as the distances along the surface between the matched tips agree on both. Of all sets that
/// grow from one pair by the nearest that contradicts none of those taken, the one of most and nearest pairs.
/// @param diagonal  of the target's box: the unit of places
std::vector<LimbMatch> match_limbs(const Points& source, const Limbs& source_limbs, const Points& target,
                                   const Limbs& target_limbs, double diagonal);

/// Where a matched limb's vertices belong before shapes are compared closely: rings about the tip are carried
/// to the other limb's rings, turned as its axis is.
struct LimbPlace {
    int vertex;  ///< of the source
    Eigen::RowVector3d place;
    double weight;  ///< 1 on the outer half, falling to 0 at the root
};
std::vector<LimbPlace> limb_places(const Mesh& source, const Limb& limb, const Limb& target);

}  // namespace automorph
