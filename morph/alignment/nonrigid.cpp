#include "morph/alignment/nonrigid.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "morph/alignment/border_pull.h"
#include "morph/alignment/coarse.h"
#include "morph/alignment/motion_solver.h"
#include "morph/alignment/places.h"
#include "morph/alignment/prior.h"
#include "morph/alignment/soft_matching.h"
#include "morph/mesh/geometry.h"
#include "morph/registration/procrustes.h"

namespace automorph {

// Notation: x current places of the source's vertices, x0 those after the similarity, x_r the reference from
// which a motion u = x - x_r is sought; all in units of the target's box diagonal.

namespace {

constexpr double kNoNormals = 1e6;  // a sigma at which all normals are alike
constexpr double kManyMore = 1.5;   // times the vertices wanted: thinning out fewer gains little
constexpr double kStill = 5e-4;     // of the target's diagonal: a similarity that moves less has arrived
constexpr double kSame = 1e-6;      // of the target's diagonal: some digits above those of files

/// The similarity that brings matched points together, applied to all points.
Points similar(const Points& x, const SoftMatches& matches) {
    const RigidMotion motion = weighted_procrustes(x, matches.centre, matches.weight);
    const double total = matches.weight.sum();
    const Eigen::RowVector3d mean = matches.weight.transpose() * x / total,
                             other = matches.weight.transpose() * matches.centre / total;
    const Points centred = (x.rowwise() - mean) * motion.R.transpose();
    double along = 0.0, size = 0.0;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        along += matches.weight[i] * centred.row(i).dot(matches.centre.row(i) - other);
        size += matches.weight[i] * centred.row(i).squaredNorm();
    }
    const double scale = size > 0.0 && along > 0.0 ? along / size : 1.0;
    return (scale * centred).rowwise() + other;
}

/// Pulls source borders onto the target's, free to slide along them.
class BorderPulls {
public:
    BorderPulls(const Points& source, const std::vector<std::vector<int>>& source_loops, const Points& target,
                const std::vector<std::vector<int>>& target_loops, const NonRigidOptions& options)
        : slide_(options.slide) {
        for (const LoopPair pair : paired_loops(source, source_loops, target, target_loops)) {
            const std::vector<int>& loop = source_loops[static_cast<std::size_t>(pair.source)];
            const std::vector<int>& partner = target_loops[static_cast<std::size_t>(pair.target)];
            Border border{loop, {}, target(partner, Eigen::all)};
            for (std::size_t k = 0; k < loop.size(); ++k) {
                const auto here = source.row(loop[k]);
                const double length = (source.row(loop[(k + 1) % loop.size()]) - here).norm() +
                                      (source.row(loop[(k + loop.size() - 1) % loop.size()]) - here).norm();
                border.weight.push_back(options.border * 0.5 * length);
            }
            borders_.push_back(std::move(border));
        }
    }

    /// Adds the borders' pulls from places x, as motions from x_r, to those of the surface.
    void add(const Points& x, const Points& reference, Pulls& pulls) const {
        for (const Border& border : borders_) {
            for (std::size_t k = 0; k < border.vertices.size(); ++k) {
                const int v = border.vertices[k];
                const LoopPoint q = nearest_on_loop(border.partner, x.row(v));
                const Eigen::Matrix3d along = q.direction * q.direction.transpose();
                const Eigen::Matrix3d trust =
                    border.weight[k] * (Eigen::Matrix3d::Identity() - slide_ * along);
                Eigen::Matrix3d& sum = pulls.trust[static_cast<std::size_t>(v)];
                const Eigen::Vector3d force =
                    sum * pulls.pull.row(v).transpose() + trust * (q.position - reference.row(v).transpose());
                sum += trust;
                pulls.pull.row(v) = sum.ldlt().solve(force).transpose();
            }
        }
    }

private:
    struct Border {
        std::vector<int> vertices;
        std::vector<double> weight;
        Points partner;
    };
    std::vector<Border> borders_;
    double slide_;
};

/// Does every vertex of the source lie on the target already? Then there is nothing to move, and the soft
/// matching would only blur it.
bool lies_on(const Mesh& source, const Mesh& target) {
    const std::vector<SurfacePlace> places = places_on(target, source.V, vertex_normals(source));
    for (std::size_t i = 0; i < places.size(); ++i) {
        if ((places[i].in(target.V) - source.V.row(static_cast<Eigen::Index>(i))).norm() > kSame)
            return false;
    }
    return true;
}

/// The alignment in units of the target's diagonal, whatever the sizes of the meshes.
NonRigidAlignment fitted(Mesh from, const std::vector<std::vector<int>>& source_loops, const Mesh& to,
                         const std::vector<std::vector<int>>& target_loops, const NonRigidOptions& options) {
    const bool part = !source_loops.empty() && target_loops.empty();
    const SoftMatching matching(oriented_points(to), part ? Coverage::Part : Coverage::Whole);
    const auto match = [&](const AlignmentLevel& level) {
        const double normal = options.normals ? level.normal : kNoNormals;
        SoftMatches matches = matching.match(oriented_points(from), {level.position, normal});
        if (!options.directional_trust) {
            for (Eigen::Index i = 0; i < matches.weight.size(); ++i)
                matches.trust[static_cast<std::size_t>(i)] = matches.weight[i] * Eigen::Matrix3d::Identity();
        }
        return matches;
    };

    for (int round = 0; round < options.similarity_rounds; ++round) {
        Points moved = similar(from.V, match(options.levels.front()));
        const double step = (moved - from.V).rowwise().norm().mean();
        from.V = std::move(moved);
        if (step < kStill) break;
    }

    const Points x0 = from.V;
    const MotionPrior prior = motion_prior(from, source_loops);
    MotionSolver solver(options.membrane * prior.membrane + options.bending * prior.bending +
                        options.border_bending * prior.border);
    const BorderPulls borders(x0, source_loops, to.V, target_loops, options);

    NonRigidAlignment result;
    for (const AlignmentLevel& level : options.levels) {
        for (int round = 0; round < (options.rounds > 0 ? options.rounds : level.rounds); ++round) {
            SoftMatches matches = match(level);
            const Points reference = x0 + options.plastic * (from.V - x0);
            result.distance = std::sqrt(
                ((matches.centre - from.V).rowwise().squaredNorm().array() * matches.weight.array()).sum() /
                matches.weight.sum());
            Pulls pulls{matches.centre - reference, std::move(matches.trust)};
            borders.add(from.V, reference, pulls);
            from.V = reference + solver.solve(pulls, options.stiffness * level.stiffness, from.V - reference);
        }
    }
    result.x = std::move(from.V);
    result.factorisations = solver.factorisations();
    result.iterations = solver.iterations();
    return result;
}

/// The mesh itself, or thinned out if it has many more vertices than are wanted.
CoarseMesh bounded(const Mesh& mesh, const std::vector<std::vector<int>>& loops, int vertices) {
    if (mesh.vertex_count() >= kManyMore * vertices) return coarse_mesh(mesh, loops, vertices);
    return {mesh, {}, loops};
}

}  // namespace

NonRigidAlignment align_nonrigid(const Mesh& source, const std::vector<std::vector<int>>& source_loops,
                                 const Points& start, const Mesh& target,
                                 const std::vector<std::vector<int>>& target_loops,
                                 const NonRigidOptions& options) {
    const double unit = bounding_box_diagonal(target.V);
    const Mesh to{target.V / unit, target.F}, from{start / unit, source.F};
    if (lies_on(from, to)) return {start, 0.0, 0, 0};
    const CoarseMesh coarse_to = bounded(to, target_loops, options.vertices),
                     coarse_from = bounded(from, source_loops, options.vertices);
    NonRigidAlignment result =
        fitted(coarse_from.mesh, coarse_from.loops, coarse_to.mesh, coarse_to.loops, options);
    if (!coarse_from.vertex.empty())
        result.x = carried(coarse_from.mesh, result.x, from.V, vertex_normals(from));
    result.x *= unit;
    return result;
}

}  // namespace automorph
