#include "tests/bench/pair_check.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <set>

#include "morph/alignment/closest_point.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/random.h"

namespace automorph::bench {

namespace {

/// Largest distance of vertices and triangle centres from another surface.
double one_sided_hausdorff(const Mesh& from, const Mesh& to) {
    if (from.triangle_count() == 0 || to.triangle_count() == 0) return 0.0;
    const ClosestPoints closest(to);
    constexpr double kAnyNormal = -2.0;
    const auto farther = [](double a, double b) { return std::max(a, b); };
    const auto distance = [&](const Eigen::Vector3d& point) {
        return (closest.query(point, Eigen::Vector3d::Zero(), kAnyNormal).in(to.V).transpose() - point)
            .norm();
    };
    return tbb::parallel_reduce(
        tbb::blocked_range<Eigen::Index>(0, from.F.rows()), 0.0,
        [&](const auto& range, double largest) {
            for (Eigen::Index f = range.begin(); f < range.end(); ++f) {
                Eigen::Vector3d centre = Eigen::Vector3d::Zero();
                for (int k = 0; k < 3; ++k) {
                    const Eigen::Vector3d corner = from.V.row(from.F(f, k));
                    largest = std::max(largest, distance(corner));
                    centre += corner / 3.0;
                }
                largest = std::max(largest, distance(centre));
            }
            return largest;
        },
        farther);
}

using Place = std::array<double, 3>;

Place place(const Points& V, Eigen::Index v) {
    return {V(v, 0), V(v, 1), V(v, 2)};
}

/// Vertices of a mesh that used merged vertices do not contain.
int missing_vertices(const Mesh& mesh, const Mesh& frame) {
    std::set<Place> places;
    for (Eigen::Index f = 0; f < frame.F.rows(); ++f) {
        for (int k = 0; k < 3; ++k) places.insert(place(frame.V, frame.F(f, k)));
    }
    int missing = 0;
    for (Eigen::Index v = 0; v < mesh.V.rows(); ++v) missing += places.count(place(mesh.V, v)) == 0;
    return missing;
}

/// Do openings of the other shape open this one where it had none?
bool opened_by(const MeshReport& other, const std::string& domain) {
    return domain == "sphere" ? other.boundary_loops > 0 : other.boundary_loops > 1;
}

std::string route(const Report& report) {
    if (report.source.closed != report.target.closed) return "capped";
    if (report.domain == "sphere, border locked") return "locked";
    return report.domain;
}

double off(const Mesh& frame, const Mesh& input, bool opened) {
    double distance = one_sided_hausdorff(frame, input);
    if (!opened) distance = std::max(distance, one_sided_hausdorff(input, frame));
    return 100.0 * distance / bounding_box_diagonal(input.V);
}

}  // namespace

PairCheck check_pair(const InputMesh& source, const InputMesh& target, const MorphOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    const Morph result = morph(source, target, options);
    PairCheck check;
    check.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    check.cpu_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    const Report& report = result.report();
    check.route = route(report);
    check.triangles = static_cast<int>(result.triangles().rows());
    check.p01 = 1.0;
    for (const MapReport& map : report.maps) {
        check.flipped += map.flipped;
        check.p01 = std::min(check.p01, map.p01);
    }
    for (const OverlayReport& overlay : report.overlays) check.turned += overlay.turned_a + overlay.turned_b;
    check.dense = report.alignment.used;
    check.confident = report.registration.confident;
    check.stages = report.stages;

    const Mesh first = result.mesh(0.0), last = result.mesh(1.0);
    const bool source_opened = opened_by(report.target, report.domain),
               target_opened = opened_by(report.source, report.domain);
    if (!source_opened) check.missing += missing_vertices(source.mesh, first);
    if (!target_opened) check.missing += missing_vertices(target.mesh, last);
    check.off_first = off(first, source.mesh, source_opened);
    check.off_last = off(last, target.mesh, target_opened);
    return check;
}

Mesh posed_at_random(Mesh mesh, std::uint64_t seed) {
    Random random(seed);
    const Eigen::Vector4d q = random.in_ball<4>();
    const Eigen::Matrix3d turn = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix();
    const double scale = std::pow(10.0, 2.0 * random.uniform() - 1.0);
    mesh.V = scale * mesh.V * turn.transpose();
    return mesh;
}

}  // namespace automorph::bench
