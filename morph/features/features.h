#pragma once

#include <vector>

#include "morph/features/curvature.h"
#include "morph/mesh/mesh.h"

namespace automorph {

/// What a candidate may be matched with.
enum class FeatureTargets {
    Vertices,    ///< every inner vertex
    Candidates,  ///< candidates only: curvature has an extremum there, and a place
};

/// Constants of [Urtasun04] Sec. 4.3, which gives no values. Curvatures are free of scale; the sphere of a
/// surface's area has K = 4 pi, about 12.6.
///
/// The defaults go beyond the paper, whose choice is scales {0} and targets Vertices: on the vertices of
/// another tessellation of the same face, curvature as it comes is noise, and matches by it lie anywhere in
/// the search disk; smoothed minima find themselves again.
struct FeatureOptions {
    double largest_gaussian = -100.0;  ///< c: a candidate is a saddle eight times as curved as the sphere
    double radius = 0.1;  ///< r, of the search in the map (radius 1), where points have mean density
    double largest_difference = 200.0;  ///< m
    FeatureTargets targets = FeatureTargets::Candidates;
    /// Widths of smoothing relative to the root of the area, 0 for none; see `smoothed`. Candidates are
    /// minima at the last, E is the mean over all.
    std::vector<double> scales{0.01, 0.02, 0.04};

    bool operator==(const FeatureOptions&) const = default;
};

/// The curvatures of a surface at all scales, and its candidates.
struct FeatureCandidates {
    std::vector<Curvature> curvatures;  ///< one per scale
    std::vector<int> vertices;          ///< ascending
};

/// Inner vertices whose K at the last scale is below c and below that of all neighbours: [Urtasun04]
/// Sec. 4.3, first list, steps 1 and 2.
/// @param surface  what counts: leave out the triangles of fillings, whose rims are borders then
/// @throws SolverFailure  smoothing failed
FeatureCandidates feature_candidates(const Mesh& surface, const FeatureOptions& options = {});

/// Two vertices that are taken for the same feature.
struct FeatureMatch {
    int vertex_a, vertex_b;
    double difference;  ///< E = |K_a - K_b| + |H_a - H_b|
};

/// Candidates of a found again in b: step 3. Sorted by vertex of a; no vertex occurs twice.
///
/// Of the targets of b within r_i of a candidate in the map the one with the smallest E is taken, if E < m.
/// r_i is r times the ratio of the spacing of b's points there and on average, "the inverse of the density":
/// every search sees about as many points. Deviation   where several candidates want one vertex, the smallest
/// E has it; the others stay without.
///
/// @param rays_a  #V x 3 registered map: (x, y, 1) on the unit disk; rays_b likewise
std::vector<FeatureMatch> match_features(const FeatureCandidates& a, const Points& rays_a,
                                         const FeatureCandidates& b, const Points& rays_b,
                                         const FeatureOptions& options = {});

}  // namespace automorph
