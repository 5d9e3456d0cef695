#include "morph/frame_check.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "morph/frames/self_intersection.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

using Eigen::Vector3d;

// What a frame may have before it is called suspicious: shares of its triangles, and of what lies between the
// ends.
constexpr double kManyReversed = 1e-3, kManyCrossing = 2e-3;
constexpr double kLeastArea = 0.8, kLeastVolume = 0.7, kMostVolume = 1.4;

/// Triangles that face against both ends, each turned as far as the frame is.
/// @param R     from the first end to the last
/// @param turn  from the first end to the frame
int reversed_triangles(const Points& V, const Triangles& F, const Endpoints& ends, const Eigen::Matrix3d& R,
                       const Eigen::Matrix3d& turn) {
    int count = 0;
    const double flat = kFlatHeight * bounding_box_diagonal(V);
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        const Vector3d n = doubled_area_vector(V, F, f);
        if (n.norm() < flat * longest_edge(V, F, f)) continue;
        count += n.dot(turn * doubled_area_vector(ends.a, F, f)) < 0.0 &&
                 n.dot(turn * R.transpose() * doubled_area_vector(ends.b, F, f)) < 0.0;
    }
    return count;
}

/// Degrees; triangles without area do not count.
double smallest_angle(const Points& V, const Triangles& F) {
    double smallest = std::numbers::pi;
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Vector3d p = V.row(F(f, k)), u = V.row(F(f, (k + 1) % 3)).transpose() - p,
                           w = V.row(F(f, (k + 2) % 3)).transpose() - p;
            const double sine = u.cross(w).norm();
            if (sine > 0.0) smallest = std::min(smallest, std::atan2(sine, u.dot(w)));
        }
    }
    return smallest * 180.0 / std::numbers::pi;
}

FrameReport looked_at(const Morph& morph, Interpolation scheme, double alpha) {
    const Mesh frame = morph.mesh(alpha, scheme);
    const Eigen::Matrix3d R =
        scheme == Interpolation::Linear ? Eigen::Matrix3d::Identity().eval() : morph.endpoints().R;
    FrameReport report;
    report.alpha = alpha;
    report.reversed = reversed_triangles(frame.V, frame.F, morph.endpoints(), R, slerp(R, alpha));
    const SelfIntersections crossing = self_intersections(frame);
    report.self_intersecting = crossing.triangles;
    report.self_intersecting_estimated = crossing.estimated;
    report.area = triangle_areas(frame).sum();
    report.volume = signed_volume(frame);
    report.smallest_angle = smallest_angle(frame.V, frame.F);
    return report;
}

/// The worst of the frames by a measure.
template <class Measure>
const FrameReport& worst(const std::vector<FrameReport>& frames, const Measure& measure) {
    return *std::max_element(frames.begin(), frames.end(), [&](const FrameReport& a, const FrameReport& b) {
        return measure(a) < measure(b);
    });
}

}  // namespace

std::vector<FrameReport> check_frames(const Morph& morph, Interpolation scheme,
                                      const std::vector<double>& alphas) {
    std::vector<FrameReport> frames{looked_at(morph, scheme, 0.0)};
    for (const double alpha : alphas) {
        if (alpha > 0.0 && alpha < 1.0) frames.push_back(looked_at(morph, scheme, alpha));
    }
    frames.push_back(looked_at(morph, scheme, 1.0));
    const FrameReport &first = frames.front(), &last = frames.back();
    // Areas grow with the square of lengths, volumes with the cube; lengths are what is interpolated.
    const auto between = [](double a, double b, double alpha, double power) {
        const double root =
            (1.0 - alpha) * std::pow(std::abs(a), 1.0 / power) + alpha * std::pow(std::abs(b), 1.0 / power);
        return std::pow(root, power);
    };
    for (FrameReport& frame : frames) {
        const double area = between(first.area, last.area, frame.alpha, 2.0),
                     volume = between(first.volume, last.volume, frame.alpha, 3.0);
        frame.area_ratio = area > 0.0 ? frame.area / area : 1.0;
        frame.volume_ratio = volume > 0.0 ? std::abs(frame.volume) / volume : 1.0;
    }
    return frames;
}

Report report_with_frames(const Morph& morph, Interpolation scheme) {
    Report report = morph.report();
    report.frames = check_frames(morph, scheme);
    const auto n = static_cast<double>(morph.triangles().rows());
    const FrameReport& reversed = worst(report.frames, [](const auto& f) { return f.reversed; });
    if (reversed.reversed > kManyReversed * n) {
        report.notes.push_back(
            fmt::format("look at the frame at {}: {} of {} triangles face against both shapes",
                        reversed.alpha, reversed.reversed, morph.triangles().rows()));
    }
    const FrameReport& crossing = worst(report.frames, [](const auto& f) { return f.self_intersecting; });
    const int ends =
        std::max(report.frames.front().self_intersecting, report.frames.back().self_intersecting);
    if (crossing.self_intersecting > ends + kManyCrossing * n) {
        report.notes.push_back(fmt::format(
            "look at the frame at {}: {}{} triangles pass through others ({} and {} in the shapes "
            "themselves)",
            crossing.alpha, crossing.self_intersecting_estimated ? "some " : "", crossing.self_intersecting,
            report.frames.front().self_intersecting, report.frames.back().self_intersecting));
    }
    const FrameReport& thin = worst(report.frames, [](const auto& f) { return -f.area_ratio; });
    if (thin.area_ratio < kLeastArea) {
        report.notes.push_back(
            fmt::format("look at the frame at {}: its area is {:.0f} % of that between the shapes'",
                        thin.alpha, 100.0 * thin.area_ratio));
    }
    if (report.source.closed && report.target.closed) {
        const FrameReport& odd = worst(
            report.frames, [](const auto& f) { return std::abs(std::log(std::max(f.volume_ratio, 1e-9))); });
        if (odd.volume_ratio < kLeastVolume || odd.volume_ratio > kMostVolume) {
            report.notes.push_back(
                fmt::format("look at the frame at {}: its volume is {:.0f} % of that between the shapes'",
                            odd.alpha, 100.0 * odd.volume_ratio));
        }
    }
    return report;
}

}  // namespace automorph
