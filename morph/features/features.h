#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Constants of [Urtasun04] Sec. 4.3, which gives no values. Curvatures are free of scale; the sphere of a
/// surface's area has K = 4 pi, about 12.6.
struct FeatureOptions {
    double largest_gaussian = -100.0;  ///< c: a candidate is a saddle eight times as curved as the sphere
    double radius = 0.1;  ///< r, of the search in the map (radius 1), where points have mean density
    double largest_difference = 100.0;  ///< m: less than what makes a candidate stand out
    /// Widths of smoothing relative to the root of the area, 0 for none; see `smoothed`. Candidates are
    /// minima at the last, E is the mean over all. "Beyond" if not {0}: {0.01, 0.02, 0.04} passes over the
    /// noise of a scan.
    std::vector<double> scales{0.0};
};

/// Two vertices that are taken for the same feature.
struct FeatureMatch {
    int vertex_a, vertex_b;
    double difference;  ///< E = |K_a - K_b| + |H_a - H_b|
};

struct Features {
    std::vector<int> candidates_a,
        candidates_b;                   ///< vertices, ascending; those of b are only counted and shown
    std::vector<FeatureMatch> matches;  ///< by vertex_a; no vertex occurs twice
};

/// Features of a found again in b, [Urtasun04] Sec. 4.3, steps 1 to 3.
///
/// Candidates  inner vertices whose K is below c and below that of all neighbours.
/// Matches     of the inner vertices of b within r_i of a candidate in the map, the one with the smallest E,
/// if E < m.
///             r_i is r times the ratio of the spacing of b's points there and on average, "the inverse of
///             the density": every search sees about as many points.
/// Deviation   where several candidates want one vertex, the smallest E has it; the others stay without.
///
/// @param a  surface that counts: leave out the triangles of fillings, whose rims are borders then
/// @param rays_a  #V x 3 registered map: (x, y, 1) on the unit disk
/// @throws SolverFailure  smoothing failed
Features match_features(const Mesh& a, const Points& rays_a, const Mesh& b, const Points& rays_b,
                        const FeatureOptions& options = {});

}  // namespace automorph
