#include "morph/registration/registration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "morph/registration/coarse_search.h"
#include "morph/registration/em_icp.h"
#include "morph/registration/pose_distance.h"
#include "morph/registration/starts.h"
#include "morph/registration/surface_sample.h"

namespace automorph {

namespace {

// A surface sample of the source meets one of the target that is denser by kDensity: the gaps of the sample,
// which Eq. (7) takes for noise, get small, at little cost in a k-d tree.
constexpr int kDensity = 4;
constexpr int kMediumPoints = 256, kMediumIterations = 10;
constexpr int kFewestFinePoints = 512, kMostFinePoints = 2048;  // of the fine sample: half the vertices

// How many different poses are refined on the medium and on the fine sample, and how much worse than the best
// (factor in the distance) they may be before.
constexpr std::size_t kMediumCandidates = 16, kFineCandidates = 4;
constexpr double kMediumRatio = 1.4, kFineRatio = 1.5;

constexpr double kDistinctAngle = 15.0 * std::numbers::pi / 180.0;  // poses closer than this count as one
constexpr double kConfidentRatio = 1.2;
// Poses whose distances differ by less cannot be told apart by shape: it is symmetric, or the two shapes differ by
// more than their poses. Of them the one that turns least is taken: files are more often than not in similar poses,
// and a morph should not turn without need.
constexpr double kTieRatio = 1.15;
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
        const EmIcpOptions options{.max_iterations = max_iterations};
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

bool distinct(const RigidMotion& a, const RigidMotion& b) {
    return rotation_angle(a.R * b.R.transpose()) > kDistinctAngle;
}

// Best first, and of each pose only the best.
std::vector<Candidate> best_distinct(std::vector<Candidate> candidates) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    std::vector<Candidate> best;
    for (const Candidate& candidate : candidates) {
        const auto differs = [&](const Candidate& other) { return distinct(candidate.motion, other.motion); };
        if (std::all_of(best.begin(), best.end(), differs)) best.push_back(candidate);
    }
    return best;
}

// The first few, at least two, without those that are clearly worse than the first.
std::vector<Candidate> promising(std::vector<Candidate> candidates) {
    candidates.resize(std::min(candidates.size(), kMediumCandidates));
    while (candidates.size() > 2 && candidates.back().distance > kMediumRatio * candidates.front().distance) {
        candidates.pop_back();
    }
    return candidates;
}

// Of candidates sorted best first, those that tie with the best are put in order of their turn.
void least_turn_first(std::vector<Candidate>& best_first) {
    const double tie = kTieRatio * best_first.front().distance;
    const auto end = std::find_if(best_first.begin(), best_first.end(),
                                  [&](const Candidate& candidate) { return candidate.distance > tie; });
    std::stable_sort(best_first.begin(), end, [](const Candidate& a, const Candidate& b) {
        return rotation_angle(a.motion.R) < rotation_angle(b.motion.R);
    });
}

struct Solution {
    EmIcpResult em;
    double residual = std::numeric_limits<double>::infinity();
    double runner_up = std::numeric_limits<double>::infinity();
};

// Full EM-ICP from the candidates that are still in the running, and the distance of the next best pose:
// among them, else among the poses that `others` lists, best first.
Solution refine_finally(const Scene& scene, const std::vector<Candidate>& candidates,
                        const std::vector<Candidate>& others, int max_iterations) {
    std::vector<Candidate> refined;
    std::vector<EmIcpResult> results;
    double best = std::numeric_limits<double>::infinity();
    for (const Candidate& candidate : candidates) {
        refined.push_back({candidate.motion, scene.distance(candidate.motion)});
        if (candidate.distance > kFineRatio * candidates.front().distance) continue;
        results.push_back(scene.refine(candidate.motion, max_iterations));
        refined.back() = {results.back().motion, scene.distance(results.back().motion)};
        best = std::min(best, refined.back().distance);
    }
    Solution solution;
    double least_turn = std::numeric_limits<double>::infinity();
    for (const EmIcpResult& result : results) {
        const double distance = scene.distance(result.motion), turn = rotation_angle(result.motion.R);
        if (distance > kTieRatio * best || turn >= least_turn) continue;
        least_turn = turn;
        solution.em = result;
        solution.residual = distance;
    }
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

// Where the files hold the same vertices (a mesh and its re-posed copy), sampling noise is uncalled for: the vertices
// lie on each other exactly. Other pairs keep their motion.
RigidMotion settled_on_vertices(const Points& source, const Points& target, const RigidMotion& start) {
    constexpr int kRounds = 10;
    constexpr double kClose = 0.02, kCoincident = 1e-6;  // mean distance, in units of the shapes' size
    if (source.rows() != target.rows()) return start;
    const NearestPoints<3> tree(target);
    RigidMotion motion = start;
    for (int round = 0; round < kRounds; ++round) {
        const Points moved = motion.apply(source);
        Points nearest(source.rows(), 3);
        double sum = 0.0;
        for (Eigen::Index i = 0; i < source.rows(); ++i) {
            std::uint32_t row = 0;
            double squared = 0.0;
            tree.query(moved.row(i).data(), 1, &row, &squared);
            nearest.row(i) = target.row(row);
            sum += std::sqrt(squared);
        }
        const double mean = sum / static_cast<double>(source.rows());
        if (mean > kClose) return start;
        motion = weighted_procrustes(source, nearest, Eigen::VectorXd::Ones(source.rows()));
        if (mean < kCoincident) return motion;
    }
    return start;
}

}  // namespace

Points Registration::apply(const Points& V) const {
    return (scale * V * R.transpose()).rowwise() + t.transpose();
}

Registration register_rigid(const Mesh& source, const Mesh& target, const RegistrationOptions& options) {
    // Size-normalised samples of both surfaces.
    const SurfaceSize source_size = surface_size(source), target_size = surface_size(target);
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
    std::vector<Candidate> medium = promising(coarse);
    for (Candidate& candidate : medium) {
        candidate.motion = medium_scene.refine(candidate.motion, kMediumIterations).motion;
        candidate.distance = medium_scene.distance(candidate.motion);
    }
    medium = best_distinct(std::move(medium));
    least_turn_first(medium);
    if (medium.size() > kFineCandidates) medium.resize(kFineCandidates);

    // EM-ICP until it stands still.
    const Scene fine_scene(a, b, fine_points, certain);
    Solution solution = refine_finally(fine_scene, medium, coarse, options.max_iterations);
    const auto normalised = [](const Mesh& mesh, const SurfaceSize& size) {
        return Points((mesh.V.rowwise() - size.centre.transpose()) / size.radius);
    };
    solution.em.motion = settled_on_vertices(normalised(source, source_size), normalised(target, target_size),
                                             solution.em.motion);

    Registration result;
    result.R = solution.em.motion.R;
    result.scale = target_size.radius / source_size.radius;
    result.t = target_size.radius * solution.em.motion.t + target_size.centre -
               result.scale * (result.R * source_size.centre);
    result.sigma = target_size.radius * solution.em.sigma;
    result.residual = solution.residual;
    result.runner_up = solution.runner_up;
    result.iterations = solution.em.iterations;
    result.converged = solution.em.converged;
    result.confident = solution.runner_up > kConfidentRatio * solution.residual;
    return result;
}

}  // namespace automorph
