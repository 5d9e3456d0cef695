#include "morph/parameterization/border_union.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace automorph {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// Raises every gap to kMinimumGap and takes the difference from what the others have above it; the sum stays
/// one turn. Gaps that are all wide enough are returned as they are.
Eigen::VectorXd widened(const Eigen::VectorXd& gaps) {
    if (gaps.minCoeff() >= kMinimumGap) return gaps;
    const Eigen::ArrayXd spare = (gaps.array() - kMinimumGap).max(0.0);
    const double factor = (kTurn - static_cast<double>(gaps.size()) * kMinimumGap) / spare.sum();
    assert(factor > 0.0);
    return (kMinimumGap + factor * spare).matrix();
}

/// Angles whose differences are the gaps, beginning at 0; the last gap closes the circle.
Eigen::VectorXd accumulated(const Eigen::VectorXd& gaps) {
    Eigen::VectorXd angles(gaps.size());
    double angle = 0.0;
    for (Eigen::Index k = 0; k < gaps.size(); ++k) {
        angles[k] = angle;
        angle += gaps[k];
    }
    return angles;
}

/// A vertex of one of the loops on the circle.
struct Mark {
    double angle;
    int index;  ///< counted from the control vertex on
    bool of_source;
    bool matched;  ///< with the next or the previous mark
};

std::vector<Mark> merged(const Eigen::VectorXd& source, const Eigen::VectorXd& target) {
    std::vector<Mark> marks;
    marks.reserve(static_cast<std::size_t>(source.size() + target.size()));
    int i = 0, j = 0;
    while (i < source.size() || j < target.size()) {
        if (j == target.size() || (i < source.size() && source[i] <= target[j])) {
            marks.push_back({source[i], i, true, false});
            ++i;
        } else {
            marks.push_back({target[j], j, false, false});
            ++j;
        }
    }
    return marks;
}

/// Matches neighbouring marks of different loops within the snap tolerance, nearest first. Afterwards a
/// matched pair is two consecutive marks.
void match(std::vector<Mark>& marks) {
    struct Candidate {
        double gap;
        std::size_t first;
    };
    std::vector<Candidate> candidates;
    for (std::size_t k = 0; k + 1 < marks.size(); ++k) {
        const double gap = marks[k + 1].angle - marks[k].angle;
        if (marks[k].of_source != marks[k + 1].of_source && gap <= kBorderSnap * kTurn)
            candidates.push_back({gap, k});
    }
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& x, const Candidate& y) {
        return x.gap != y.gap ? x.gap < y.gap : x.first < y.first;
    });
    for (const Candidate& c : candidates) {
        if (marks[c.first].matched || marks[c.first + 1].matched) continue;
        marks[c.first].matched = marks[c.first + 1].matched = true;
    }
}

/// Turns positions counted from the control vertex into sites of the loop.
class Side {
public:
    explicit Side(const LoopAngles& loop)
        : angles_(loop.angles), start_(loop.start), last_(static_cast<int>(loop.angles.size()) - 1) {}

    BorderSite vertex(int index) {
        last_ = index;
        return {loop_index(index), loop_index(index), 0.0};
    }

    /// A point on the edge after the last vertex; that edge may pass angle 0.
    BorderSite point(double angle) const {
        const bool passes = last_ + 1 == angles_.size();
        const double begin = angles_[last_], end = passes ? angles_[0] + kTurn : angles_[last_ + 1];
        if (passes && angle < angles_[0]) angle += kTurn;
        return {loop_index(last_), loop_index(last_ + 1), (angle - begin) / (end - begin)};
    }

private:
    int loop_index(int index) const { return (start_ + index) % static_cast<int>(angles_.size()); }

    const Eigen::VectorXd& angles_;
    int start_, last_;
};

}  // namespace

Points loop_points(const Mesh& mesh, const std::vector<int>& loop) {
    Points points(static_cast<Eigen::Index>(loop.size()), 3);
    for (Eigen::Index k = 0; k < points.rows(); ++k)
        points.row(k) = mesh.V.row(loop[static_cast<std::size_t>(k)]);
    return points;
}

Eigen::VectorXd arc_length_angles(const Points& loop, int start) {
    const Eigen::Index n = loop.rows();
    assert(n >= 3 && start >= 0 && start < n);
    Eigen::VectorXd gaps(n);
    for (Eigen::Index k = 0; k < n; ++k) {
        gaps[k] = (loop.row((start + k + 1) % n) - loop.row((start + k) % n)).stableNorm();
    }
    const double length = gaps.sum();
    if (length > 0.0) {
        gaps *= kTurn / length;
    } else {
        gaps.setConstant(kTurn / static_cast<double>(n));  // all in one place: nothing to be proportional to
    }
    return accumulated(widened(gaps));
}

BorderUnion border_union(const Points& source_loop, const Points& target_loop, const BorderControl& control) {
    assert(!control.target_reversed);
    return border_union(LoopAngles{arc_length_angles(source_loop, control.source), control.source},
                        LoopAngles{arc_length_angles(target_loop, control.target), control.target});
}

BorderUnion border_union(const LoopAngles& source_loop, const LoopAngles& target_loop) {
    std::vector<Mark> marks = merged(source_loop.angles, target_loop.angles);
    match(marks);

    BorderUnion u;
    u.source_size = static_cast<int>(source_loop.angles.size());
    u.target_size = static_cast<int>(target_loop.angles.size());
    Side source(source_loop), target(target_loop);
    std::vector<double> angles;
    angles.reserve(marks.size());
    for (std::size_t k = 0; k < marks.size(); ++k) {
        if (marks[k].matched) {
            const Mark &first = marks[k], &second = marks[k + 1];
            u.source.push_back(source.vertex(first.of_source ? first.index : second.index));
            u.target.push_back(target.vertex(first.of_source ? second.index : first.index));
            angles.push_back(0.5 * (first.angle + second.angle));
            ++u.shared;
            ++k;
        } else {
            u.source.push_back(marks[k].of_source ? source.vertex(marks[k].index)
                                                  : source.point(marks[k].angle));
            u.target.push_back(marks[k].of_source ? target.point(marks[k].angle)
                                                  : target.vertex(marks[k].index));
            angles.push_back(marks[k].angle);
        }
    }

    u.angles =
        Eigen::Map<const Eigen::VectorXd>(angles.data(), static_cast<Eigen::Index>(angles.size())).array() -
        angles[0];
    Eigen::VectorXd gaps(u.size());
    for (int k = 0; k < u.size(); ++k) gaps[k] = (k + 1 < u.size() ? u.angles[k + 1] : kTurn) - u.angles[k];
    if (gaps.minCoeff() < kMinimumGap) u.angles = accumulated(widened(gaps));
    return u;
}

BorderUnion mirrored(const BorderUnion& u) {
    BorderUnion m = u;
    const auto flipped = [](BorderSite site, int n) {
        site.from = (n - site.from) % n;
        site.to = (n - site.to) % n;
        return site;
    };
    for (int k = 0; k < u.size(); ++k) {
        const int from = (u.size() - k) % u.size();
        m.source[k] = flipped(u.source[from], u.source_size);
        m.target[k] = flipped(u.target[from], u.target_size);
        m.angles[k] = k == 0 ? 0.0 : kTurn - u.angles[from];
    }
    return m;
}

Eigen::Vector3d position(const Points& loop, const BorderSite& site) {
    if (site.is_vertex()) return loop.row(site.from);
    return (1.0 - site.ratio) * loop.row(site.from) + site.ratio * loop.row(site.to);
}

Points border_rays(const Eigen::VectorXd& angles) {
    Points rays(angles.size(), 3);
    for (Eigen::Index k = 0; k < angles.size(); ++k)
        rays.row(k) << std::cos(angles[k]), std::sin(angles[k]), 1.0;
    return rays;
}

}  // namespace automorph
