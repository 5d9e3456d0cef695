#include "morph/sphere_alignment/align_spheres.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "morph/mesh/errors.h"
#include "morph/parameterization/map_quality.h"
#include "morph/registration/procrustes.h"
#include "morph/sphere_alignment/movable_map.h"
#include "morph/sphere_alignment/smooth_field.h"

namespace automorph {

namespace {

/// Widths of the warp's Gaussian, radians, in equal ratios.
constexpr double kWidest = 0.6, kNarrowest = 0.13;
constexpr int kLevels = 8;
/// Relaxing sweeps after each level, and after the last.
constexpr int kSweepsPerLevel = 3, kFinestSweeps = 8;

/// Places that a tangent field leads to.
Points shifted(const Points& rays, const SmoothField& field) {
    Points wanted(rays.rows(), 3);
    for (Eigen::Index v = 0; v < rays.rows(); ++v) {
        const Eigen::Vector3d x = rays.row(v);
        const Eigen::Vector3d shift = field(x);
        wanted.row(v) = (x + shift - shift.dot(x) * x).normalized();
    }
    return wanted;
}

double mean_angle(const Points& a, const Points& b, const Eigen::VectorXd& weights) {
    double sum = 0.0;
    for (Eigen::Index k = 0; k < a.rows(); ++k) {
        // Exact for small and for large angles.
        sum += weights[k] * 2.0 * std::atan2((a.row(k) - b.row(k)).norm(), (a.row(k) + b.row(k)).norm());
    }
    return sum / weights.sum();
}

void require_positive(const char* what, const Mesh& mesh, const Points& rays) {
    const int flipped = flipped_triangles(mesh.F, rays);
    if (flipped > 0) {
        throw SolverFailure(fmt::format("alignment on the sphere: {} of {} triangles of the {} flipped",
                                        flipped, mesh.triangle_count(), what));
    }
}

}  // namespace

AlignedSpheres align_spheres(const MappedMesh& a, const MappedMesh& b, const SurfaceMatches& matches) {
    AlignedSpheres result{a.rays, b.rays, static_cast<int>(matches.on_a.size())};
    if (matches.on_a.empty()) return result;
    const Points at_a = rays_of(a.rays, matches.on_a), at_b = rays_of(b.rays, matches.on_b);
    result.before = mean_angle(at_a, at_b, matches.weights);

    if (b.loop.empty()) {
        const Eigen::Matrix3d H = at_b.transpose() * matches.weights.asDiagonal() * at_a;
        result.rays_b = (b.rays * best_rotation(H).transpose()).rowwise().normalized();
        require_positive("target, turned,", b.mesh, result.rays_b);
    }
    result.rotated = mean_angle(at_a, rays_of(result.rays_b, matches.on_b), matches.weights);

    MovableMap map_a(a.mesh, a.loop, result.rays_a), map_b(b.mesh, b.loop, result.rays_b);
    const double ratio = std::pow(kNarrowest / kWidest, 1.0 / (kLevels - 1));
    double width = kWidest;
    for (int level = 0; level < kLevels; ++level, width *= ratio) {
        const Points from = rays_of(map_a.rays(), matches.on_a), to = rays_of(map_b.rays(), matches.on_b);
        const Points half = 0.5 * (to - from);
        map_a.move(shifted(map_a.rays(), SmoothField(from, half, matches.weights, width)));
        map_b.move(shifted(map_b.rays(), SmoothField(to, -half, matches.weights, width)));
        const int sweeps = level + 1 < kLevels ? kSweepsPerLevel : kFinestSweeps;
        map_a.relax(sweeps);
        map_b.relax(sweeps);
    }
    result.rays_a = map_a.rays();
    result.rays_b = map_b.rays();
    result.after =
        mean_angle(rays_of(map_a.rays(), matches.on_a), rays_of(map_b.rays(), matches.on_b), matches.weights);
    require_positive("source", a.mesh, result.rays_a);
    require_positive("target", b.mesh, result.rays_b);
    return result;
}

}  // namespace automorph
