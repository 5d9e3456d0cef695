#include "morph/registration/registration.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
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

// Sizes of shapes of which one lacks a part, or that noise has swollen, mislead: sizes up to kSizeSteps steps
// off are tried, first coarsely, then finely, and taken where the shapes then are the same.
constexpr int kSizeSteps = 8, kNearSizeSteps = 3;
constexpr double kCoarseSize = 1.04, kFineSize = 1.01;
constexpr int kSizePoints = 320, kSizeIterations = 8;
constexpr double kSameShape = 0.02;   // of the target's radius: samples of one surface are nearer than this
constexpr double kBetterSize = 0.9;   // of the distance at equal sizes
constexpr double kAgree = 0.03;       // of the target's radius: different shapes keep the sizes they have
constexpr double kHopeless = 2.0;     // times kAgree, at the coarse sizes: the rest of the search is spared
constexpr double kLeastGain = 0.005;  // of the target's radius: less may be chance of the samples
// Points of a part that the target lacks draw the pose towards its border: the end of the way without them.
constexpr double kPresent = 0.75;  // share of the source's points that go on
constexpr int kPresentRounds = 4;

constexpr double kConfidentRatio = 1.2;
constexpr double kRival = 2.0;  // times the best distance: no pose beyond it makes the best one doubtful
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

    // The polish alone, for the points of the source that lie nearest the target in the pose reached so far.
    EmIcpResult refine_present(EmIcpResult refined, int max_iterations) const {
        const EmIcpOptions options{.max_iterations = max_iterations, .neighbours = kNeighbours};
        for (int round = 0; round < kPresentRounds; ++round) {
            const Points moved = refined.motion.apply(probes_.points);
            std::vector<std::pair<double, int>> order;
            for (int i = 0; i < probes_.size(); ++i) {
                std::uint32_t nearest = 0;
                double squared_distance = 0.0;
                tree_.query(moved.row(i).data(), 1, &nearest, &squared_distance);
                order.emplace_back(squared_distance, i);
            }
            std::sort(order.begin(), order.end());
            order.resize(static_cast<std::size_t>(kPresent * static_cast<double>(order.size())));
            std::vector<int> present;
            for (const auto& [squared_distance, i] : order) present.push_back(i);
            std::sort(present.begin(), present.end());
            refined = polish_along_normals(probes_.points(present, Eigen::all), tree_, target_.normals,
                                           refined.motion, options);
        }
        return refined;
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
    double scale = 1.0;  // of the source, on top of its size
};

// A motion and the size of the source that goes with it.
struct SizedCandidate {
    double scale = 1.0;
    Candidate pose;
    bool converged = false;
};

SizedCandidate refined_at(double scale, const RigidMotion& start, SurfaceSample source,
                          const SurfaceSample& target, int points, int max_iterations, bool certain) {
    source.points *= scale;
    source.spacing *= scale;
    const Scene scene(source, target, points, certain);
    const EmIcpResult whole = scene.refine(start, max_iterations);
    const EmIcpResult present = scene.refine_present(whole, max_iterations);
    const double distance = scene.distance(whole.motion), of_present = scene.distance(present.motion);
    if (of_present < distance) return {scale, {present.motion, of_present}, present.converged};
    return {scale, {whole.motion, distance}, whole.converged};
}

// The best of sizes step^k around the one given, each with its own motion. The sizes nearest are tried first,
// and more on a side while that side's last is the best so far.
SizedCandidate best_size(const SizedCandidate& from, double step, const SurfaceSample& source,
                         const SurfaceSample& target, bool certain) {
    std::vector<SizedCandidate> tries(2 * kSizeSteps + 1);
    const auto try_sizes = [&](int first, int end) {
        tbb::parallel_for(first, end, [&](int k) {
            const double scale = from.scale * std::pow(step, static_cast<double>(k - kSizeSteps));
            tries[static_cast<std::size_t>(k)] =
                refined_at(scale, from.pose.motion, source, target, kSizePoints, kSizeIterations, certain);
        });
    };
    int first = kSizeSteps - kNearSizeSteps, end = kSizeSteps + kNearSizeSteps + 1;
    try_sizes(first, end);
    while (true) {
        const auto best =
            std::min_element(tries.begin() + first, tries.begin() + end,
                             [](const auto& a, const auto& b) { return a.pose.distance < b.pose.distance; });
        const int at = static_cast<int>(best - tries.begin());
        if (at == first && first > 0) {
            const int farther = std::max(0, first - kNearSizeSteps);
            try_sizes(farther, first);
            first = farther;
        } else if (at + 1 == end && end <= 2 * kSizeSteps) {
            const int farther = std::min(2 * kSizeSteps + 1, end + kNearSizeSteps);
            try_sizes(end, farther);
            end = farther;
        } else {
            return *best;
        }
    }
}

// The solution with the size of the source set right, if that makes both agree clearly better.
// @param good_enough  a solution that is worse than this at the coarse sizes is not looked into any more
Solution resized(Solution solution, const SurfaceSample& source, const SurfaceSample& target, int points,
                 int max_iterations, bool certain, double good_enough) {
    SizedCandidate best{1.0, {solution.em.motion, solution.residual}, solution.em.converged};
    best = best_size(best, kCoarseSize, source, target, certain);
    if (best.pose.distance > good_enough) return solution;
    best = best_size(best, kFineSize, source, target, certain);
    best = refined_at(best.scale, best.pose.motion, source, target, points, max_iterations, certain);
    if (best.pose.distance >
        std::min({kAgree, kBetterSize * solution.residual, solution.residual - kLeastGain}))
        return solution;
    solution.scale = best.scale;
    solution.em.motion = best.pose.motion;
    solution.em.converged = best.converged;
    solution.residual = best.pose.distance;
    return solution;
}

// Full EM-ICP from the candidates that are still in the running, and the distance of the next best pose:
// among them, else the first different one of `others`. All with the sizes set right, unless the shapes
// agree.
Solution refine_finally(const Scene& scene, const std::vector<Candidate>& candidates,
                        const std::vector<Candidate>& others, int max_iterations,
                        const std::function<Solution(const Solution&, double)>& resize) {
    std::vector<Solution> solutions(candidates.size());
    tbb::parallel_for(std::size_t{0}, candidates.size(), [&](std::size_t i) {
        solutions[i].em = scene.refine(candidates[i].motion, max_iterations);
        solutions[i].residual = scene.distance(solutions[i].em.motion);
    });
    const bool agree = std::any_of(solutions.begin(), solutions.end(),
                                   [](const Solution& s) { return s.residual < kSameShape; });
    if (!agree) {
        tbb::parallel_for(std::size_t{0}, solutions.size(),
                          [&](std::size_t i) { solutions[i] = resize(solutions[i], kHopeless * kAgree); });
    }
    std::vector<Candidate> refined;
    for (const Solution& solution : solutions) refined.push_back({solution.em.motion, solution.residual});
    Solution solution = solutions[least_turn_among_best(refined)];
    for (const Candidate& candidate : refined) {
        if (distinct(candidate.motion, solution.em.motion))
            solution.runner_up = std::min(solution.runner_up, candidate.distance);
    }
    if (std::isfinite(solution.runner_up)) return solution;
    const auto other = std::find_if(others.begin(), others.end(), [&](const Candidate& candidate) {
        return distinct(candidate.motion, solution.em.motion);
    });
    if (other == others.end()) return solution;
    Solution second;
    second.em.motion = other->motion;
    second.residual = scene.distance(other->motion);
    // One that is far behind at the coarse sizes does not catch up at the fine ones.
    const double rival = std::min(kHopeless * kAgree, kRival * solution.residual);
    solution.runner_up = agree ? second.residual : resize(second, rival).residual;
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
    return refine_finally(fine_scene, finalists, others, options.max_iterations,
                          [&](const Solution& solution, double good_enough) {
                              return resized(solution, a, b, fine_points, options.max_iterations, certain,
                                             good_enough);
                          });
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
    const RigidMotion motion = settled_on_vertices(solution.scale * normalised(source, source_size),
                                                   normalised(target, target_size), solution.em.motion);
    Registration result;
    result.R = motion.R;
    result.scale = solution.scale * target_size.radius / source_size.radius;
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
