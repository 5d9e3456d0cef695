#pragma once

#include <vector>

#include "morph/features/features.h"
#include "morph/features/warp.h"

namespace automorph {

/// A disk as the alignment sees it.
struct MappedDisk {
    const Mesh& mesh;              ///< with all its triangles
    const Triangles& surface;      ///< those whose curvature counts: without fillings
    const std::vector<int>& loop;  ///< border
    const Points& rays;            ///< (x, y, 1) on the unit disk
};

struct AlignOptions {
    FeatureOptions matching;
    WarpOptions warping;
    /// How often features are matched again on the warped maps, as long as there are more of them each time.
    /// "Beyond" if not 0.
    int rematches = 2;

    bool operator==(const AlignOptions&) const = default;
};

/// Two disk maps whose features lie on one another.
struct AlignedMaps {
    Points rays_a, rays_b;
    std::vector<int> candidates_a, candidates_b;  ///< vertices, ascending
    std::vector<FeatureMatch> matches;
    int in_place = 0;              ///< matches whose vertices are at one place, to twice the warp's tolerance
    int warps = 0;                 ///< the first and those after a rematch
    int rounds = 0;                ///< of all warps
    double distance_before = 0.0;  ///< of the two vertices of a match on the maps given, mean; 0 without any
    double distance_after = 0.0;   ///< the same on the maps returned
};

/// The curvature adjustment of [Urtasun04] Sec. 4.3: features of both surfaces are matched, and both maps are
/// warped such that the features of a pair meet half-way, w = (f^a + f^b) / 2.
/// Both maps stay one-to-one with their borders as they were.
/// @pre the maps are registered and cover the disk
AlignedMaps align_features(const MappedDisk& a, const MappedDisk& b, const AlignOptions& options = {});

}  // namespace automorph
