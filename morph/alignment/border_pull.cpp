#include "morph/alignment/border_pull.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace automorph {

namespace {

std::vector<Eigen::RowVector3d> centroids(const Points& points, const std::vector<std::vector<int>>& loops) {
    std::vector<Eigen::RowVector3d> result;
    for (const std::vector<int>& loop : loops) result.push_back(points(loop, Eigen::all).colwise().mean());
    return result;
}

}  // namespace

std::vector<LoopPair> paired_loops(const Points& source_points,
                                   const std::vector<std::vector<int>>& source_loops,
                                   const Points& target_points,
                                   const std::vector<std::vector<int>>& target_loops) {
    std::vector<LoopPair> pairs;
    if (source_loops.empty() || target_loops.empty()) return pairs;
    pairs.push_back({0, 0});
    const auto source = centroids(source_points, source_loops),
               target = centroids(target_points, target_loops);
    std::vector<std::tuple<double, int, int>> candidates;
    for (std::size_t i = 1; i < source.size(); ++i) {
        for (std::size_t j = 1; j < target.size(); ++j)
            candidates.emplace_back((source[i] - target[j]).norm(), static_cast<int>(i), static_cast<int>(j));
    }
    std::sort(candidates.begin(), candidates.end());
    std::vector<char> source_taken(source.size(), 0), target_taken(target.size(), 0);
    for (const auto& [distance, i, j] : candidates) {
        auto &a = source_taken[static_cast<std::size_t>(i)], &b = target_taken[static_cast<std::size_t>(j)];
        if (a || b) continue;
        a = b = 1;
        pairs.push_back({i, j});
    }
    return pairs;
}

LoopPoint nearest_on_loop(const Points& loop, const Eigen::Vector3d& query) {
    LoopPoint best;
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < loop.rows(); ++k) {
        const Eigen::Vector3d a = loop.row(k), edge = loop.row((k + 1) % loop.rows()).transpose() - a;
        const double length2 = edge.squaredNorm();
        const double ratio = length2 > 0.0 ? std::clamp((query - a).dot(edge) / length2, 0.0, 1.0) : 0.0;
        const Eigen::Vector3d point = a + ratio * edge;
        const double distance2 = (query - point).squaredNorm();
        if (distance2 >= least) continue;
        least = distance2;
        best = {static_cast<int>(k), ratio, point, edge.stableNormalized()};
    }
    return best;
}

}  // namespace automorph
