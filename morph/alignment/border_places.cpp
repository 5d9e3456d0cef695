#include "morph/alignment/border_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "morph/alignment/border_pull.h"

namespace automorph {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kArcLength = 0.02;  // share of the source's own arc length

/// In [0, 2 pi).
double wrapped(double angle) {
    const double rest = angle - kTurn * std::floor(angle / kTurn);
    return rest < kTurn ? rest : 0.0;
}

}  // namespace

std::optional<Eigen::VectorXd> monotone_angles(const Points& aligned, const Points& target) {
    const Eigen::VectorXd on_target = arc_length_angles(target, 0);
    const Eigen::Index n = aligned.rows();
    Eigen::VectorXd u(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        const LoopPoint q = nearest_on_loop(target, aligned.row(k));
        const double begin = on_target[q.segment],
                     end = q.segment + 1 < on_target.size() ? on_target[q.segment + 1] : kTurn;
        u[k] = begin + q.ratio * (end - begin);
    }
    // Without jumps of a turn; the loop has to close after exactly one.
    for (Eigen::Index k = 1; k < n; ++k) u[k] = u[k - 1] + std::remainder(u[k] - u[k - 1], kTurn);
    const double around = u[n - 1] + std::remainder(u[0] - u[n - 1], kTurn) - u[0];
    if (std::abs(around - kTurn) > 1e-6) return std::nullopt;

    Eigen::VectorXd most(n), least(n);
    double running = u.maxCoeff() - kTurn;
    for (Eigen::Index k = 0; k < n; ++k) most[k] = running = std::max(running, u[k]);
    running = u.minCoeff() + kTurn;
    for (Eigen::Index k = n; k-- > 0;) least[k] = running = std::min(running, u[k]);
    u = 0.5 * (most + least);

    const Eigen::VectorXd own = arc_length_angles(aligned, 0);
    return (1.0 - kArcLength) * u.array() + kArcLength * (own.array() + (u - own).mean());
}

std::optional<BorderUnion> aligned_border(const Points& aligned, const Points& target) {
    const std::optional<Eigen::VectorXd> angles = monotone_angles(aligned, target);
    if (!angles) return std::nullopt;
    const auto n = static_cast<int>(angles->size());
    // The vertex from which the angles ascend in [0, 2 pi).
    LoopAngles source{Eigen::VectorXd(n), 0};
    for (int k = 0; k < n; ++k) {
        if (wrapped((*angles)[k]) < wrapped((*angles)[source.start])) source.start = k;
    }
    for (int k = 0; k < n; ++k) source.angles[k] = wrapped((*angles)[(source.start + k) % n]);
    if (!std::is_sorted(source.angles.begin(), source.angles.end())) return std::nullopt;
    return border_union(source, {arc_length_angles(target, 0), 0});
}

SurfacePlace place_on_loop(const std::vector<int>& loop, const Eigen::VectorXd& loop_angles, double angle) {
    angle = wrapped(angle);
    const auto after = std::upper_bound(loop_angles.begin(), loop_angles.end(), angle);
    const auto k = static_cast<Eigen::Index>(after - loop_angles.begin()) - 1;
    const double begin = loop_angles[k], end = k + 1 < loop_angles.size() ? loop_angles[k + 1] : kTurn;
    const double ratio = std::clamp((angle - begin) / (end - begin), 0.0, 1.0);
    const int from = loop[static_cast<std::size_t>(k)],
              to = loop[static_cast<std::size_t>((k + 1) % loop_angles.size())];
    return {{from, to, to}, {1.0 - ratio, ratio, 0.0}};
}

}  // namespace automorph
