#include "morph/registration/registration.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "morph/registration/candidates.h"
#include "morph/registration/coarse_search.h"
#include "morph/registration/denoise.h"
#include "morph/registration/em_icp.h"
#include "morph/registration/pose_distance.h"
#include "morph/registration/starts.h"
#include "morph/registration/surface_sample.h"
#include "morph/registration/vertex_fit.h"

namespace automorph {

namespace {

// A surface sample of the source meets one of the target that is denser by kDensity: the gaps of the sample,
// which Eq. (7) takes for noise, get small, at little cost in a k-d tree.
constexpr int kDensity = 4;
constexpr int kNeighbours = 6;  // kept in each row of p_ij: the seventh would get about e^-4
constexpr int kMediumPoints = 160, kMediumIterations = 5;
constexpr int kFewestFinePoints = 256, kMostFinePoints = 2048;  // of the fine sample: half the vertices

// How many different poses are refined on the medium and on the fine sample, and how much worse than the best
// (factor in the distance) they may be before.
constexpr std::size_t kMediumCandidates = 16, kFineCandidates = 4;
constexpr double kMediumRatio = 1.3, kFineRatio = 1.5;

constexpr double kConfidentRatio = 1.2;
// Open meshes may face either way in their file; that both agree is the better guess among near equals.
constexpr double kReversedHandicap = 1.1;

// Both shapes, size-normalised, at one sampling density.
class Scene {
public:
    Scene(const SurfaceSample& source, const SurfaceSample& target, int points, bool orientation_is_certain)
        : source_(thin_out(source, kDensity * points)),
          target_(thin_out(target, kDensity * points)),
          probes_(thin_out(source_, points)),
          tree_(target_.points),
          distance_(source_, target_),
          orientation_is_certain_(orientation_is_certain) {}

    double distance(const RigidMotion& motion) const {
        const double as_given = distance_(motion, probes_.size());
        if (orientation_is_certain_) return as_given;
        return std::min(as_given, kReversedHandicap * distance_(motion, probes_.size(), -1.0));
    }

    // EM-ICP, then the better of its answer and of what the polish makes of it.
    EmIcpResult refine(const RigidMotion& start, int max_iterations) const {
        const EmIcpOptions options{.max_iterations = max_iterations, .neighbours = kNeighbours};
        const EmIcpResult em = em_icp(probes_.points, tree_, start, options);
        EmIcpResult polished =
            polish_along_normals(probes_.points, tree_, target_.normals, em.motion, options);
        if (distance(polished.motion) > distance(em.motion)) return em;
        polished.iterations += em.iterations;
        polished.converged = polished.converged && em.converged;
        return polished;
    }

private:
    SurfaceSample source_, target_, probes_;
    NearestPoints<3> tree_;
    PoseDistance distance_;
    bool orientation_is_certain_;
};

struct Solution {
    EmIcpResult em;
    double residual = 0.0;
    double runner_up = std::numeric_limits<double>::infinity();
};

// Full EM-ICP from the candidates that are still in the running, and the distance of the next best pose:
// among them, else the first different one of `others`.
Solution refine_finally(const Scene& scene, const std::vector<Candidate>& candidates,
                        const std::vector<Candidate>& others, int max_iterations) {
    std::vector<Candidate> refined(candidates.size());
    std::vector<EmIcpResult> results(candidates.size());
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        results[i] = scene.refine(candidates[i].motion, max_iterations);
        refined[i] = {results[i].motion, scene.distance(results[i].motion)};
    });
    const std::size_t choice = least_turn_among_best(refined);
    Solution solution{results[choice], refined[choice].distance};
    for (const Candidate& candidate : refined) {
        if (distinct(candidate.motion, solution.em.motion)) {
            solution.runner_up = std::min(solution.runner_up, candidate.distance);
        }
    }
    if (std::isfinite(solution.runner_up)) return solution;
    const auto other = std::find_if(others.begin(), others.end(), [&](const Candidate& candidate) {
        return distinct(candidate.motion, solution.em.motion);
    });
    if (other != others.end()) solution.runner_up = scene.distance(other->motion);
    return solution;
}

Points normalised(const Mesh& mesh, const SurfaceSize& size) {
    return (mesh.V.rowwise() - size.centre.transpose()) / size.radius;
}

// The pose of `source` on `target`, both as sizes say normalised.
Solution search(const Mesh& source, const SurfaceSize& source_size, const Mesh& target,
                const SurfaceSize& target_size, const RegistrationOptions& options) {
    const int fine_points = std::clamp(std::max(source.vertex_count(), target.vertex_count()) / 2,
                                       kFewestFinePoints, kMostFinePoints);
    const SurfaceSample a = sample_surface(source, source_size, kDensity * fine_points, 2 * options.seed);
    const SurfaceSample b = sample_surface(target, target_size, kDensity * fine_points, 2 * options.seed + 1);
    const bool certain = is_closed(source) && is_closed(target);

    // A few steps of EM-ICP from all over SO(3), on few points.
    const std::vector<Candidate> coarse =
        best_distinct(coarse_search(a, b, starting_rotations(a.points, b.points, options.seed), certain));

    // Some more, and the polish, from the best of them.
    const Scene medium_scene(a, b, kMediumPoints, certain);
    std::vector<Candidate> medium = promising(coarse, kMediumCandidates, kMediumRatio);
    tbb::parallel_for(std::size_t{0}, medium.size(), [&](std::size_t i) {
        medium[i].motion = medium_scene.refine(medium[i].motion, kMediumIterations).motion;
        medium[i].distance = medium_scene.distance(medium[i].motion);
    });
    medium = best_distinct(std::move(medium));
    std::vector<Candidate> others = medium;
    others.insert(others.end(), coarse.begin(), coarse.end());

    // EM-ICP until it stands still, from those that may still win, and the one that wins if they tie.
    std::vector<Candidate> finalists = promising(medium, kFineCandidates, kFineRatio);
    if (const std::size_t calm = least_turn_among_best(medium); calm >= finalists.size()) {
        finalists.push_back(medium[calm]);
    }
    const Scene fine_scene(a, b, fine_points, certain);
    return refine_finally(fine_scene, finalists, others, options.max_iterations);
}

}  // namespace

Points Registration::apply(const Points& V) const {
    return (scale * V * R.transpose()).rowwise() + t.transpose();
}

Points Registration::inverse(const Points& V) const {
    return (V.rowwise() - t.transpose()) * R / scale;
}

Registration register_rigid(const Mesh& source, const Mesh& target, const RegistrationOptions& options) {
    // What is not a surface is refused by its size, before anything else.
    SurfaceSize source_size = surface_size(source), target_size = surface_size(target);
    const std::optional<Mesh> smooth_source = denoised(source), smooth_target = denoised(target);
    if (smooth_source) source_size = surface_size(*smooth_source);
    if (smooth_target) target_size = surface_size(*smooth_target);

    const Solution solution = search(smooth_source ? *smooth_source : source, source_size,
                                     smooth_target ? *smooth_target : target, target_size, options);
    const RigidMotion motion = settled_on_vertices(normalised(source, source_size),
                                                   normalised(target, target_size), solution.em.motion);
    Registration result;
    result.R = motion.R;
    result.scale = target_size.radius / source_size.radius;
    result.t =
        target_size.radius * motion.t + target_size.centre - result.scale * (result.R * source_size.centre);
    result.sigma = mean_nearest_distance(result.apply(source.V), target.V);
    result.residual = solution.residual;
    result.runner_up = solution.runner_up;
    result.iterations = solution.em.iterations;
    result.converged = solution.em.converged;
    result.confident = solution.runner_up > kConfidentRatio * solution.residual;
    return result;
}

}  // namespace automorph
