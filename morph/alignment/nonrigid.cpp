#include "morph/alignment/nonrigid.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "morph/alignment/border_pull.h"
#include "morph/alignment/coarse.h"
#include "morph/alignment/limb_pull.h"
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

bool has_many_more(const Mesh& mesh, int vertices) {
    return mesh.vertex_count() >= kManyMore * vertices;
}

/// The mesh itself, or thinned out if it has many more vertices than are wanted.
CoarseMesh bounded(const Mesh& mesh, const std::vector<std::vector<int>>& loops, int vertices) {
    if (has_many_more(mesh, vertices)) return coarse_mesh(mesh, loops, vertices);
    return {mesh, {}, loops};
}

/// The alignment at one resolution, in units of the target's diagonal, whatever the sizes of the meshes.
class Fit {
public:
    /// @param vertices  a mesh with many more is thinned out to about so many
    Fit(const Mesh& source, const std::vector<std::vector<int>>& source_loops, const Mesh& target,
        const std::vector<std::vector<int>>& target_loops, int vertices, const NonRigidOptions& options)
        : options_(options),
          source_(bounded(source, source_loops, vertices)),
          target_(bounded(target, target_loops, vertices)),
          matching_(oriented_points(target_.mesh),
                    !source_loops.empty() && target_loops.empty() ? Coverage::Part : Coverage::Whole),
          x0_(source_.mesh.V),
          x_(x0_) {}

    /// Turns, shifts and scales the source as its matches say, until it stands still.
    void settle() {
        for (int round = 0; round < options_.similarity_rounds; ++round) {
            Points moved = similar(x_, match(options_.levels.front()));
            const double step = (moved - x_).rowwise().norm().mean();
            x_ = std::move(moved);
            if (step < kStill) break;
        }
        x0_ = x_;
    }

    /// Goes on from where a coarser fit has come.
    void continue_from(const Fit& coarser) {
        x0_ = coarser.carried_to(source_.mesh, coarser.x0_);
        x_ = coarser.carried_to(source_.mesh, coarser.x_);
        result_ = coarser.result_;
    }

    /// @param with_limbs  at so many of the levels limbs are pulled onto one another
    void bend(std::span<const AlignmentLevel> levels, std::size_t with_limbs = 0) {
        if (levels.empty()) return;
        std::optional<LimbPulls> limbs;
        if (with_limbs > 0 && options_.limbs > 0.0) {
            limbs.emplace(Mesh{x0_, source_.mesh.F}, source_.loops, target_.mesh, target_.loops,
                          options_.limbs);
            note_limbs(*limbs);
        }
        const MotionPrior prior = motion_prior({x0_, source_.mesh.F}, source_.loops);
        MotionSolver solver(options_.membrane * prior.membrane + options_.bending * prior.bending +
                            options_.border_bending * prior.border);
        const BorderPulls borders(x0_, source_.loops, target_.mesh.V, target_.loops, options_);
        for (std::size_t k = 0; k < levels.size(); ++k) {
            const AlignmentLevel& level = levels[k];
            for (int round = 0; round < (options_.rounds > 0 ? options_.rounds : level.rounds); ++round) {
                SoftMatches matches = match(level);
                const Points reference = x0_ + options_.plastic * (x_ - x0_);
                result_.distance = std::sqrt(
                    ((matches.centre - x_).rowwise().squaredNorm().array() * matches.weight.array()).sum() /
                    matches.weight.sum());
                Pulls pulls{matches.centre - reference, std::move(matches.trust)};
                borders.add(x_, reference, pulls);
                if (limbs && k < with_limbs) limbs->add(x_, reference, pulls);
                x_ = reference + solver.solve(pulls, options_.stiffness * level.stiffness, x_ - reference);
            }
        }
        result_.factorisations += solver.factorisations();
        result_.iterations += solver.iterations();
    }

    /// The motion so far, of the vertices of the whole source.
    NonRigidAlignment result_on(const Mesh& source) const {
        NonRigidAlignment result = result_;
        result.x = source_.vertex.empty() ? x_ : carried_to(source, x_);
        return result;
    }

private:
    void note_limbs(const LimbPulls& limbs) {
        result_.source_limbs = limbs.source_limbs();
        result_.target_limbs = limbs.target_limbs();
        for (const auto& [a, b] : limbs.matched_tips())
            result_.matched_tips.emplace_back(source_.whole(a), target_.whole(b));
    }

    SoftMatches match(const AlignmentLevel& level) const {
        const double normal = options_.normals ? level.normal : kNoNormals;
        SoftMatches matches =
            matching_.match(oriented_points({x_, source_.mesh.F}), {level.position, normal});
        if (!options_.directional_trust) {
            for (Eigen::Index i = 0; i < matches.weight.size(); ++i)
                matches.trust[static_cast<std::size_t>(i)] = matches.weight[i] * Eigen::Matrix3d::Identity();
        }
        return matches;
    }

    Points carried_to(const Mesh& mesh, const Points& moved) const {
        return carried(source_.mesh, moved, mesh.V, vertex_normals(mesh));
    }

    const NonRigidOptions& options_;
    CoarseMesh source_, target_;
    SoftMatching matching_;
    Points x0_, x_;
    NonRigidAlignment result_;  // but for x
};

}  // namespace

NonRigidAlignment align_nonrigid(const Mesh& source, const std::vector<std::vector<int>>& source_loops,
                                 const Points& start, const Mesh& target,
                                 const std::vector<std::vector<int>>& target_loops,
                                 const NonRigidOptions& options) {
    const double unit = bounding_box_diagonal(target.V);
    const Mesh to{target.V / unit, target.F}, from{start / unit, source.F};
    if (lies_on(from, to)) return {start};

    const std::span<const AlignmentLevel> levels = options.levels;
    const std::size_t first = std::min(levels.size(), static_cast<std::size_t>(options.coarse_levels));
    Fit fine(from, source_loops, to, target_loops, options.vertices, options);
    if (first > 0 &&
        (has_many_more(from, options.coarse_vertices) || has_many_more(to, options.coarse_vertices))) {
        Fit coarse(from, source_loops, to, target_loops, options.coarse_vertices, options);
        coarse.settle();
        coarse.bend(levels.first(first), first);
        fine.continue_from(coarse);
        fine.bend(levels.subspan(first));
    } else {
        fine.settle();
        fine.bend(levels, first);
    }
    NonRigidAlignment result = fine.result_on(from);
    result.x *= unit;
    return result;
}

}  // namespace automorph
