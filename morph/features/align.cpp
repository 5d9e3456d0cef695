#include "morph/features/align.h"

namespace automorph {

namespace {

double distance(const Points& rays_a, const Points& rays_b, const FeatureMatch& match) {
    return (rays_a.row(match.vertex_a) - rays_b.row(match.vertex_b)).norm();
}

/// Mean over the matches, 0 without any.
double mean_distance(const Points& rays_a, const Points& rays_b, const std::vector<FeatureMatch>& matches) {
    double sum = 0.0;
    for (const FeatureMatch& match : matches) sum += distance(rays_a, rays_b, match);
    return matches.empty() ? 0.0 : sum / static_cast<double>(matches.size());
}

/// Steps 2 to 5 of the second list: both maps, given as `maps`, go to the mean places of the matches.
AlignedMaps warped(const MappedDisk& a, const MappedDisk& b, AlignedMaps maps,
                   std::vector<FeatureMatch> matches, const WarpOptions& options) {
    std::vector<int> of_a, of_b;
    for (const FeatureMatch& match : matches) {
        of_a.push_back(match.vertex_a);
        of_b.push_back(match.vertex_b);
    }
    const Points places = 0.5 * (maps.rays_a(of_a, Eigen::all) + maps.rays_b(of_b, Eigen::all));
    WarpedMap map_a = warp_map(a.mesh, a.loop, maps.rays_a, of_a, places, options),
              map_b = warp_map(b.mesh, b.loop, maps.rays_b, of_b, places, options);
    maps.rays_a = std::move(map_a.rays);
    maps.rays_b = std::move(map_b.rays);
    maps.matches = std::move(matches);
    maps.warps += 1;
    maps.rounds += map_a.rounds + map_b.rounds;
    maps.in_place = 0;
    for (const FeatureMatch& match : maps.matches)
        maps.in_place += distance(maps.rays_a, maps.rays_b, match) <= 2.0 * options.tolerance;
    return maps;
}

}  // namespace

AlignedMaps align_features(const MappedDisk& a, const MappedDisk& b, const AlignOptions& options) {
    const FeatureCandidates of_a = feature_candidates({a.mesh.V, a.surface}, options.matching),
                            of_b = feature_candidates({b.mesh.V, b.surface}, options.matching);
    AlignedMaps result;
    result.rays_a = a.rays;
    result.rays_b = b.rays;
    result.candidates_a = of_a.vertices;
    result.candidates_b = of_b.vertices;
    for (int match = 0; match <= options.rematches; ++match) {
        std::vector<FeatureMatch> matches =
            match_features(of_a, result.rays_a, of_b, result.rays_b, options.matching);
        if (matches.size() <= result.matches.size()) break;
        AlignedMaps next = warped(a, b, result, std::move(matches), options.warping);
        if (match > 0 && next.in_place <= result.in_place) break;
        result = std::move(next);
    }
    result.distance_before = mean_distance(a.rays, b.rays, result.matches);
    result.distance_after = mean_distance(result.rays_a, result.rays_b, result.matches);
    return result;
}

}  // namespace automorph
