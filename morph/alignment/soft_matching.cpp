#include "morph/alignment/soft_matching.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

constexpr int kNeighbours = 12;  // of each point among the other surface's
constexpr int kScalings = 10;    // Sinkhorn rounds; the power makes each contract to 0.64
constexpr double kPower = 0.8;   // 1 would be balanced: every point has to find a partner
constexpr int kSpreadNeighbours = 40;
constexpr SoftMatching::Scales kSpreadScales{0.03, 0.3};
constexpr double kSpreadUnit = 0.01;  // a spread of this length halves the trust
constexpr double kTiny = 1e-200;      // its scalings are still numbers
constexpr Eigen::Index kGrain = 256;

using Features = NearestPoints<6>::Rows;

Features features(const OrientedPoints& surface, const SoftMatching::Scales& scales) {
    Features rows(surface.points.rows(), 6);
    rows << surface.points / scales.position, surface.normals / scales.normal;
    return rows;
}

template <class Body>
void for_rows(Eigen::Index n, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, n, kGrain), [&](const auto& range) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) body(i);
    });
}

/// The k nearest rows of `tree` for every row of `queries`: neighbour m of row i at i * k + m.
struct Neighbours {
    int k;
    std::vector<std::uint32_t> row;
    std::vector<double> squared_distance;
};

Neighbours nearest(const NearestPoints<6>& tree, const Features& queries, int k) {
    k = std::min(k, tree.size());
    const auto count = static_cast<std::size_t>(queries.rows()) * static_cast<std::size_t>(k);
    Neighbours found{k, std::vector<std::uint32_t>(count), std::vector<double>(count)};
    for_rows(queries.rows(), [&](Eigen::Index i) {
        const auto at = static_cast<std::size_t>(i) * static_cast<std::size_t>(k);
        tree.query(queries.row(i).data(), k, &found.row[at], &found.squared_distance[at]);
    });
    return found;
}

/// Pairs by source row, each once: offsets into target and kernel.
struct Pairs {
    std::vector<std::size_t> start;
    std::vector<int> target;
    std::vector<double> kernel;
};

Pairs united(const Neighbours& of_source, const Neighbours& of_target, Eigen::Index sources) {
    struct Neighbour {
        int target;
        double squared_distance;
    };
    const auto n = static_cast<std::size_t>(sources);
    std::vector<std::vector<Neighbour>> rows(n);
    for (std::size_t i = 0; i < n; ++i) {
        for (int m = 0; m < of_source.k; ++m) {
            const std::size_t at = i * static_cast<std::size_t>(of_source.k) + static_cast<std::size_t>(m);
            rows[i].push_back({static_cast<int>(of_source.row[at]), of_source.squared_distance[at]});
        }
    }
    for (std::size_t at = 0; at < of_target.row.size(); ++at) {
        const int j = static_cast<int>(at / static_cast<std::size_t>(of_target.k));
        rows[of_target.row[at]].push_back({j, of_target.squared_distance[at]});
    }
    Pairs pairs;
    pairs.start.push_back(0);
    for (auto& row : rows) {
        std::sort(row.begin(), row.end(),
                  [](const Neighbour& a, const Neighbour& b) { return a.target < b.target; });
        for (std::size_t m = 0; m < row.size(); ++m) {
            if (m > 0 && row[m].target == row[m - 1].target) continue;
            pairs.target.push_back(row[m].target);
            pairs.kernel.push_back(std::exp(-0.5 * row[m].squared_distance));
        }
        pairs.start.push_back(pairs.target.size());
    }
    return pairs;
}

/// The same pairs by target: `pair` indexes into kernel.
struct Transposed {
    std::vector<std::size_t> start, pair;
    std::vector<int> source;
};

Transposed transposed(const Pairs& pairs, Eigen::Index targets) {
    Transposed t;
    t.start.assign(static_cast<std::size_t>(targets) + 1, 0);
    for (const int j : pairs.target) ++t.start[static_cast<std::size_t>(j) + 1];
    for (std::size_t j = 1; j < t.start.size(); ++j) t.start[j] += t.start[j - 1];
    t.pair.resize(pairs.target.size());
    t.source.resize(pairs.target.size());
    std::vector<std::size_t> next(t.start.begin(), t.start.end() - 1);
    for (std::size_t i = 0; i + 1 < pairs.start.size(); ++i) {
        for (std::size_t p = pairs.start[i]; p < pairs.start[i + 1]; ++p) {
            const std::size_t at = next[static_cast<std::size_t>(pairs.target[p])]++;
            t.pair[at] = p;
            t.source[at] = static_cast<int>(i);
        }
    }
    return t;
}

/// Where a surface is sampled more densely than on average there is more to be seen: its points count more.
Eigen::VectorXd emphasis(const Eigen::VectorXd& share) {
    const double least = 1e-3 / static_cast<double>(share.size());
    return (share.array().max(least) * static_cast<double>(share.size())).pow(kPower - 1.0);
}

/// Replaces the kernel by P_ij = a_i s_i K_ij t_j b_j, s and t the shares of the surfaces. With the shares
/// beside the scalings these do not depend on how finely the surfaces are sampled.
void scale_to_shares(Pairs& pairs, const Eigen::VectorXd& source_share, const Eigen::VectorXd& target_share,
                     double target_power) {
    const Transposed columns = transposed(pairs, target_share.size());
    const Eigen::VectorXd source_emphasis = emphasis(source_share), target_emphasis = emphasis(target_share);
    Eigen::VectorXd a = Eigen::VectorXd::Ones(source_share.size()),
                    b = Eigen::VectorXd::Ones(target_share.size());
    for (int round = 0; round < kScalings; ++round) {
        for_rows(b.size(), [&](Eigen::Index j) {
            double sum = 0.0;
            for (std::size_t at = columns.start[static_cast<std::size_t>(j)];
                 at < columns.start[static_cast<std::size_t>(j) + 1]; ++at)
                sum +=
                    pairs.kernel[columns.pair[at]] * source_share[columns.source[at]] * a[columns.source[at]];
            b[j] = target_emphasis[j] * std::pow(std::max(sum, kTiny), -target_power);
        });
        for_rows(a.size(), [&](Eigen::Index i) {
            double sum = 0.0;
            for (std::size_t p = pairs.start[static_cast<std::size_t>(i)];
                 p < pairs.start[static_cast<std::size_t>(i) + 1]; ++p)
                sum += pairs.kernel[p] * target_share[pairs.target[p]] * b[pairs.target[p]];
            a[i] = source_emphasis[i] * std::pow(std::max(sum, kTiny), -kPower);
        });
    }
    a.array() *= source_share.array();
    b.array() *= target_share.array();
    for (std::size_t i = 0; i + 1 < pairs.start.size(); ++i) {
        for (std::size_t p = pairs.start[i]; p < pairs.start[i + 1]; ++p)
            pairs.kernel[p] *= a[static_cast<Eigen::Index>(i)] * b[pairs.target[p]];
    }
}

std::vector<Eigen::Matrix3d> spreads(const OrientedPoints& target) {
    const Features rows = features(target, kSpreadScales);
    const Neighbours likes = nearest(NearestPoints<6>(rows), rows, kSpreadNeighbours);
    std::vector<Eigen::Matrix3d> spread(static_cast<std::size_t>(rows.rows()));
    for_rows(rows.rows(), [&](Eigen::Index j) {
        double sum = 0.0;
        Eigen::Vector3d mean = Eigen::Vector3d::Zero();
        Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
        for (int m = 0; m < likes.k; ++m) {
            const auto at = static_cast<std::size_t>(j * likes.k + m);
            const auto l = static_cast<Eigen::Index>(likes.row[at]);
            const double weight = target.weight[l] * std::exp(-0.5 * likes.squared_distance[at]);
            const Eigen::Vector3d y = (target.points.row(l) - target.points.row(j)).transpose();
            sum += weight;
            mean += weight * y;
            moment += weight * y * y.transpose();
        }
        if (sum > 0.0) {
            mean /= sum;
            spread[static_cast<std::size_t>(j)] = moment / sum - mean * mean.transpose();
        } else {
            spread[static_cast<std::size_t>(j)].setZero();
        }
    });
    return spread;
}

}  // namespace

OrientedPoints oriented_points(const Mesh& mesh) {
    Eigen::VectorXd area = vertex_areas(mesh);
    const double total = area.sum();
    area /= total > 0.0 ? total : 1.0;
    return {mesh.V, vertex_normals(mesh), std::move(area)};
}

SoftMatching::SoftMatching(OrientedPoints target, Coverage coverage)
    : target_(std::move(target)),
      target_power_(coverage == Coverage::Whole ? kPower : 0.0),
      spread_(spreads(target_)) {}

SoftMatches SoftMatching::match(const OrientedPoints& source, const Scales& scales) const {
    const NearestPoints<6> source_tree(features(source, scales)), target_tree(features(target_, scales));
    Pairs pairs = united(nearest(target_tree, source_tree.points(), kNeighbours),
                         nearest(source_tree, target_tree.points(), kNeighbours), source.points.rows());
    scale_to_shares(pairs, source.weight, target_.weight, target_power_);

    SoftMatches matches{source.points, Eigen::VectorXd::Zero(source.points.rows()),
                        std::vector<Eigen::Matrix3d>(static_cast<std::size_t>(source.points.rows()))};
    for_rows(source.points.rows(), [&](Eigen::Index i) {
        const auto row = static_cast<std::size_t>(i);
        double sum = 0.0;
        Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        for (std::size_t p = pairs.start[row]; p < pairs.start[row + 1]; ++p) {
            const int j = pairs.target[p];
            sum += pairs.kernel[p];
            centre += pairs.kernel[p] * target_.points.row(j);
            spread += pairs.kernel[p] * spread_[static_cast<std::size_t>(j)];
        }
        matches.trust[row].setZero();
        if (sum <= kTiny) return;
        matches.weight[i] = sum;
        matches.centre.row(i) = centre / sum;
        const Eigen::Matrix3d penalty =
            spread / (sum * kSpreadUnit * kSpreadUnit) + Eigen::Matrix3d::Identity();
        matches.trust[row] = sum * penalty.inverse();
    });
    return matches;
}

}  // namespace automorph
