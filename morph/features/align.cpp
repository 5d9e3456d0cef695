#include "morph/features/align.h"

namespace automorph {

AlignedMaps align_features(const MappedDisk& a, const MappedDisk& b, const FeatureOptions& matching,
                           const WarpOptions& warping) {
    AlignedMaps result;
    result.features = match_features({a.mesh.V, a.surface}, a.rays, {b.mesh.V, b.surface}, b.rays, matching);
    const auto n = static_cast<Eigen::Index>(result.features.matches.size());
    std::vector<int> of_a, of_b;
    Points places(n, 3);
    for (const FeatureMatch& match : result.features.matches) {
        places.row(static_cast<Eigen::Index>(of_a.size())) =
            0.5 * (a.rays.row(match.vertex_a) + b.rays.row(match.vertex_b));
        of_a.push_back(match.vertex_a);
        of_b.push_back(match.vertex_b);
    }
    WarpedMap warped_a = warp_map(a.mesh, a.loop, a.rays, of_a, places, warping),
              warped_b = warp_map(b.mesh, b.loop, b.rays, of_b, places, warping);
    result.rays_a = std::move(warped_a.rays);
    result.rays_b = std::move(warped_b.rays);
    result.rounds = warped_a.rounds + warped_b.rounds;
    for (Eigen::Index i = 0; i < n; ++i) {
        const int u = of_a[static_cast<std::size_t>(i)], v = of_b[static_cast<std::size_t>(i)];
        const double distance = (result.rays_a.row(u) - result.rays_b.row(v)).norm();
        result.in_place += distance <= 2.0 * warping.tolerance;
        result.distance_before += (a.rays.row(u) - b.rays.row(v)).norm() / static_cast<double>(n);
        result.distance_after += distance / static_cast<double>(n);
    }
    return result;
}

}  // namespace automorph
