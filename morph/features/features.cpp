#include "morph/features/features.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "morph/registration/nearest.h"

namespace automorph {

namespace {

/// Points from which the density at a place is taken.
constexpr int kDensityPoints = 16;

/// Curvatures at every scale; the last decides on candidates.
std::vector<Curvature> curvatures(const Mesh& mesh, const HalfEdgeTable& half_edges,
                                  const std::vector<double>& scales) {
    const Curvature finest = curvature(mesh, half_edges);
    std::vector<Curvature> result;
    for (const double scale : scales) result.push_back(scale > 0.0 ? smoothed(finest, mesh, scale) : finest);
    return result;
}

/// K is smaller than at every neighbour; of equal ones the smaller index counts as smaller. Neighbours
/// without curvature do not count.
bool is_minimum(const HalfEdgeTable& half_edges, const Curvature& curvature, int v) {
    const int first = half_edges.outgoing(v);
    int h = first;
    do {  // v is inner: its half-edges close around it
        const int w = half_edges.to(h);
        if (curvature[w] && std::tie(curvature.gaussian[w], w) < std::tie(curvature.gaussian[v], v))
            return false;
        h = half_edges.turn(h);
    } while (h != first);
    return true;
}

/// Per vertex: a candidate of the other surface may be matched with it.
std::vector<char> targets(const FeatureCandidates& candidates, FeatureTargets which) {
    std::vector<char> result = candidates.curvatures.back().defined;
    if (which == FeatureTargets::Vertices) return result;
    std::fill(result.begin(), result.end(), 0);
    for (const int v : candidates.vertices) result[static_cast<std::size_t>(v)] = 1;
    return result;
}

/// The vertices of a map around a place, in a disk that holds about as many wherever it is.
class MapDisk {
public:
    MapDisk(const Points& rays, double radius) : tree_(rays), radius_(radius) {}

    std::vector<int> around(const Eigen::Vector3d& centre) {
        query(centre, std::min(kDensityPoints, tree_.size()));
        // k points per pi R^2 here, #V per pi in the whole disk.
        const double spacing =
            std::sqrt(squared_.back() / static_cast<double>(squared_.size()) * tree_.size());
        const double reach = radius_ * spacing;
        while (squared_.back() <= reach * reach && static_cast<int>(rows_.size()) < tree_.size())
            query(centre, std::min(2 * static_cast<int>(rows_.size()), tree_.size()));
        std::vector<int> found;
        for (std::size_t k = 0; k < rows_.size() && squared_[k] <= reach * reach; ++k)
            found.push_back(static_cast<int>(rows_[k]));
        return found;
    }

private:
    void query(const Eigen::Vector3d& centre, int count) {
        rows_.resize(static_cast<std::size_t>(count));
        squared_.resize(static_cast<std::size_t>(count));
        tree_.query(centre.data(), count, rows_.data(), squared_.data());
    }

    NearestPoints<3> tree_;
    double radius_;
    std::vector<std::uint32_t> rows_;
    std::vector<double> squared_;
};

double difference(const std::vector<Curvature>& a, int v, const std::vector<Curvature>& b, int w) {
    double sum = 0.0;
    for (std::size_t s = 0; s < a.size(); ++s) {
        sum += std::abs(a[s].gaussian[v] - b[s].gaussian[w]) + std::abs(a[s].mean[v] - b[s].mean[w]);
    }
    return sum / static_cast<double>(a.size());
}

/// One match per vertex of b, the smallest difference; sorted by vertex of a.
std::vector<FeatureMatch> one_to_one(std::vector<FeatureMatch> matches) {
    std::sort(matches.begin(), matches.end(), [](const FeatureMatch& x, const FeatureMatch& y) {
        return std::tie(x.vertex_b, x.difference, x.vertex_a) <
               std::tie(y.vertex_b, y.difference, y.vertex_a);
    });
    const auto end =
        std::unique(matches.begin(), matches.end(),
                    [](const FeatureMatch& x, const FeatureMatch& y) { return x.vertex_b == y.vertex_b; });
    matches.erase(end, matches.end());
    std::sort(matches.begin(), matches.end(),
              [](const FeatureMatch& x, const FeatureMatch& y) { return x.vertex_a < y.vertex_a; });
    return matches;
}

}  // namespace

FeatureCandidates feature_candidates(const Mesh& surface, const FeatureOptions& options) {
    const HalfEdgeTable half_edges(surface.F, surface.vertex_count());
    FeatureCandidates result;
    result.curvatures = curvatures(surface, half_edges, options.scales);
    const Curvature& coarsest = result.curvatures.back();
    for (int v = 0; v < surface.vertex_count(); ++v) {
        if (coarsest[v] && coarsest.gaussian[v] < options.largest_gaussian &&
            is_minimum(half_edges, coarsest, v))
            result.vertices.push_back(v);
    }
    return result;
}

std::vector<FeatureMatch> match_features(const FeatureCandidates& a, const Points& rays_a,
                                         const FeatureCandidates& b, const Points& rays_b,
                                         const FeatureOptions& options) {
    const std::vector<char> target = targets(b, options.targets);
    MapDisk disk(rays_b, options.radius);
    std::vector<FeatureMatch> matches;
    for (const int v : a.vertices) {
        FeatureMatch best{v, -1, options.largest_difference};
        for (const int w : disk.around(rays_a.row(v))) {
            if (!target[static_cast<std::size_t>(w)]) continue;
            const double here = difference(a.curvatures, v, b.curvatures, w);
            if (here < best.difference) best = {v, w, here};
        }
        if (best.vertex_b >= 0) matches.push_back(best);
    }
    return one_to_one(std::move(matches));
}

}  // namespace automorph
