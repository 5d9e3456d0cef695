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

/// Two disk maps whose features lie on one another.
struct AlignedMaps {
    Points rays_a, rays_b;
    Features features;  ///< matched before the warp
    int in_place =
        0;           ///< matches whose two vertices are at one place now, to twice the tolerance of the warp
    int rounds = 0;  ///< of both warps
    double distance_before = 0.0, distance_after = 0.0;  ///< mean over the matches, in the map; 0 without any
};

/// The curvature adjustment of [Urtasun04] Sec. 4.3: features of both surfaces are matched, and both maps are
/// warped such that the features of a pair meet half-way, w = (f^a + f^b) / 2. Both maps stay one-to-one with
/// their borders as they were.
/// @pre the maps are registered and cover the disk
AlignedMaps align_features(const MappedDisk& a, const MappedDisk& b, const FeatureOptions& matching = {},
                           const WarpOptions& warping = {});

}  // namespace automorph
