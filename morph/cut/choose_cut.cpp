#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "morph/cut/cut.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

using Eigen::Vector3d;

/// Planes tried through one line.
constexpr int kPencil = 24;
/// Matches tried before giving up.
constexpr int kMostMatches = 60;
/// The next match lies at least this share of the source's diagonal from those that failed.
constexpr double kMatchSpacing = 0.05;
/// A match nearer to the centre than this share of the diagonal gives no line to speak of.
constexpr double kShortestArm = 0.05;

struct ShapeMatch {
    double p;
    int source, target;
};

/// All pairs by decreasing responsibility.
std::vector<ShapeMatch> best_matches(const Mesh& source, const Mesh& target,
                                     const Registration& registration) {
    const auto p = responsibilities(source.V, target.V, registration);
    std::vector<ShapeMatch> matches;
    for (int i = 0; i < p.outerSize(); ++i) {
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(p, i); it; ++it) {
            matches.push_back({it.value(), i, static_cast<int>(it.col())});
        }
    }
    std::sort(matches.begin(), matches.end(), [](const ShapeMatch& x, const ShapeMatch& y) {
        return std::tuple(-x.p, x.source, x.target) < std::tuple(-y.p, y.source, y.target);
    });
    return matches;
}

/// A closed shape with what every plane needs of it.
struct Solid {
    const Mesh& mesh;
    Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    Vector3d centre = centre_of_mass(mesh);

    Plane through_centre(const Vector3d& normal) const { return {normal, normal.dot(centre)}; }

    /// Border length squared over area of the worse half: 4 pi for a flat disk, small where a map would be
    /// squeezed; 0 if the halves are not two disks.
    double suitability(const Plane& plane) const {
        const Section s = section(mesh, topology, plane);
        const double area = std::max(s.area_above, s.area_below);
        return s.loops == 1 && area > 0.0 ? s.length * s.length / area : 0.0;
    }
};

/// The best plane of the pencil through a match; nothing if none cuts both shapes into disks.
std::optional<CutPlanes> best_of_pencil(const Solid& source, const Solid& target, const ShapeMatch& match,
                                        const Eigen::Matrix3d& R) {
    const Vector3d arm = source.mesh.V.row(match.source).transpose() - source.centre;
    const Vector3d target_arm = (target.mesh.V.row(match.target).transpose() - target.centre).normalized();
    const Vector3d u = arm.unitOrthogonal(), v = arm.normalized().cross(u);
    std::optional<CutPlanes> best;
    double best_score = 0.0;
    for (int k = 0; k < kPencil; ++k) {
        const double angle = M_PI * k / kPencil;
        const Vector3d normal = std::cos(angle) * u + std::sin(angle) * v;
        Vector3d turned = R * normal;
        turned -= turned.dot(target_arm) * target_arm;
        if (turned.norm() < 0.1) continue;  // the target's match lies across the plane
        const Plane a = source.through_centre(normal), b = target.through_centre(turned.normalized());
        double score = source.suitability(a);
        if (score > best_score) score = std::min(score, target.suitability(b));
        if (score <= best_score) continue;
        best_score = score;
        best = CutPlanes{a, b, match.source, match.target, match.p, 0};
    }
    return best;
}

}  // namespace

CutPlanes choose_cut(const Mesh& source, const Mesh& target, const Registration& registration) {
    const Solid a{source}, b{target};
    const double size_a = bounding_box_diagonal(source.V), size_b = bounding_box_diagonal(target.V);
    std::vector<Vector3d> failed;
    for (const ShapeMatch& match : best_matches(source, target, registration)) {
        const Vector3d x = source.V.row(match.source), y = target.V.row(match.target);
        if ((x - a.centre).norm() < kShortestArm * size_a || (y - b.centre).norm() < kShortestArm * size_b)
            continue;
        const auto near = [&](const Vector3d& f) { return (f - x).norm() < kMatchSpacing * size_a; };
        if (std::any_of(failed.begin(), failed.end(), near)) continue;
        if (auto planes = best_of_pencil(a, b, match, registration.R)) {
            planes->matches_tried = static_cast<int>(failed.size()) + 1;
            return *planes;
        }
        failed.push_back(x);
        if (static_cast<int>(failed.size()) == kMostMatches) break;
    }
    throw SolverFailure(
        fmt::format("cut: no plane through the centres cuts both shapes into two disks each ({} matches, {} "
                    "planes each, were tried); the domain auto or sphere needs no plane",
                    failed.size(), kPencil));
}

CutPlanes unregistered_cut(const Mesh& source, const Mesh& target) {
    const Solid a{source}, b{target};
    std::vector<Vector3d> normals{Vector3d::UnitZ(), Vector3d::UnitY(), Vector3d::UnitX()};
    for (int k = 0; k < kPencil; ++k) {  // a spiral of directions over the half sphere
        const double z = (k + 0.5) / kPencil, angle = k * M_PI * (3.0 - std::sqrt(5.0)),
                     r = std::sqrt(1.0 - z * z);
        normals.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
    for (const Vector3d& normal : normals) {
        const Plane p = a.through_centre(normal), q = b.through_centre(normal);
        if (a.suitability(p) > 0.0 && b.suitability(q) > 0.0) return {p, q, -1, -1, 0.0, 0};
    }
    throw SolverFailure(fmt::format(
        "cut: none of {} planes through the centres cuts both shapes into two disks each; the domain auto or "
        "sphere needs no plane",
        normals.size()));
}

}  // namespace automorph
