#pragma once

#include <Eigen/Core>
#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/parameterization/border_control.h"

namespace automorph {

/// Border vertices of the two meshes whose angles differ by less than this share of the circle are one vertex
/// of the union. It stands above the noise of files with six digits (a mesh against its own copy must not
/// double its border) and far below a border edge (1e-3 of one on a border of 1000 vertices).
constexpr double kBorderSnap = 1e-6;

/// Smallest angle between neighbours on the circle, radians. Three points of the circle with gaps g and h
/// turn by a determinant of g h (g + h) / 2; rounding their coordinates to doubles changes it by about 3e-16
/// (g + h). At 1e-7 the determinant is more than ten times that, so that the polygon is strictly convex in
/// doubles.
constexpr double kMinimumGap = 1e-7;

/// A place on a loop: vertex `from` of the loop when from == to, else the point (1 - ratio) p_from + ratio
/// p_to of the edge between the neighbours `from` and `to` (either order), 0 < ratio < 1.
struct BorderSite {
    int from = 0, to = 0;  ///< indices into the loop
    double ratio = 0.0;
    bool is_vertex() const { return from == to; }
};

/// The union of two borders: one vertex per angle, and where it lies on either loop. [Urtasun04] Sec. 4.2,
/// Fig. 3.
struct BorderUnion {
    std::vector<BorderSite> source,
        target;              ///< #border each, in counter-clockwise order, [0] the control vertices
    Eigen::VectorXd angles;  ///< #border, radians in [0, 2 pi), strictly increasing, angles[0] = 0
    int source_size = 0, target_size = 0;  ///< vertices of either loop
    int shared = 0;  ///< union vertices that are vertices of both loops, control vertices included

    int size() const { return static_cast<int>(angles.size()); }
};

/// 3D positions of the loop's vertices, #loop x 3.
Points loop_points(const Mesh& mesh, const std::vector<int>& loop);

/// Angles proportional to arc length from loop vertex `start` on, radians in [0, 2 pi), strictly increasing.
/// Neighbours closer than kMinimumGap (edges of no length) are spread to it at the others' expense.
Eigen::VectorXd arc_length_angles(const Points& loop, int start);

/// Merges the arc-length angles of both loops, given by their points in order (#loop x 3).
///
/// Deviation  vertices within kBorderSnap are matched one-to-one, nearest first, only with a direct neighbour
/// on
///            the circle (so the matching is monotone), and share the mean of their angles.
/// Cost       O(n log n); symmetric in source and target.
/// @pre at least 3 vertices each, `control.target_reversed` false
BorderUnion border_union(const Points& source_loop, const Points& target_loop, const BorderControl& control);

/// The same for angles that are known: angle k of a loop, ascending in [0, 2 pi), belongs to its vertex
/// (start + k) mod size. [0] of the union is the vertex of smallest angle, which gets angle 0.
struct LoopAngles {
    Eigen::VectorXd angles;
    int start = 0;
};
BorderUnion border_union(const LoopAngles& source, const LoopAngles& target);

/// The same union for loops that run the other way round with their first vertices kept (the second halves of
/// two cut meshes): the same union vertices from the same pairs of loop points with the same ratios in the
/// same order of operands, so that 3D positions agree to the last bit. Union vertex k becomes (size - k) mod
/// size. mirrored(mirrored(u)) has the sites of u.
BorderUnion mirrored(const BorderUnion& u);

/// 3D place of a site on a loop given by its points.
Eigen::Vector3d position(const Points& loop, const BorderSite& site);

/// Rays (cos, sin, 1) of the angles, #border x 3: identical doubles for both maps.
Points border_rays(const Eigen::VectorXd& angles);

}  // namespace automorph
