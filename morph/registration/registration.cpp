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

constexpr double kDistinctAngle = 15.0 * std::numbers::pi / 180.0;  // poses closer than this count as one
constexpr double kConfidentRatio = 1.15;

constexpr int kCoarsePoints = 128;
constexpr int kMediumPoints = 256;
constexpr int kMediumIterations = 10;
constexpr int kMediumCandidates = 8;
constexpr int kFineCandidates = 3;
constexpr int kFewestPoints = 512, kMostPoints = 2048;

bool distinct(const RigidMotion& a, const RigidMotion& b) {
    return rotation_angle(a.R * b.R.transpose()) > kDistinctAngle;
}

// The best `count` candidates of which no two are the same pose, best first.
std::vector<Candidate> best_distinct(std::vector<Candidate> candidates, std::size_t count) {
    std::stable_sort(candidates.begin(), candidates.end(),
                     [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
    std::vector<Candidate> best;
    for (const Candidate& candidate : candidates) {
        if (best.size() == count) break;
        if (std::all_of(best.begin(), best.end(),
                        [&](const Candidate& other) { return distinct(candidate.motion, other.motion); })) {
            best.push_back(candidate);
        }
    }
    return best;
}

}  // namespace

Points Registration::apply(const Points& V) const {
    return (scale * V * R.transpose()).rowwise() + t.transpose();
}

Registration register_rigid(const Mesh& source, const Mesh& target, const RegistrationOptions& options) {
    const SurfaceSize source_size = surface_size(source), target_size = surface_size(target);
    const int fine = std::clamp(std::max(source.vertex_count(), target.vertex_count()) / 2, kFewestPoints, kMostPoints);
    const SurfaceSample a = sample_surface(source, source_size, 4 * fine, 2 * options.seed);
    const SurfaceSample b = sample_surface(target, target_size, 4 * fine, 2 * options.seed + 1);
    const bool certain = is_closed(source) && is_closed(target);

    std::vector<Candidate> coarse = coarse_search(thin_out(a, kCoarsePoints), thin_out(b, kCoarsePoints),
        starting_rotations(a.points, b.points, options.seed), {.orientation_is_certain = certain});

    const PoseDistance pose_distance(a, b);
    NearestPoints<3> medium_tree(thin_out(b, 4 * kMediumPoints).points);
    std::vector<Candidate> medium = best_distinct(coarse, kMediumCandidates);
    for (auto& c : medium) {
        c.motion = em_icp(thin_out(a, kMediumPoints).points, medium_tree, c.motion, {.max_iterations = kMediumIterations, .neighbours=4}).motion;
        c.distance = pose_distance(c.motion, kMediumPoints);
        if (!certain) c.distance = std::min(c.distance, pose_distance(c.motion, kMediumPoints, -1.0));
    }
    NearestPoints<3> fine_tree(b.points);
    std::vector<Candidate> best = best_distinct(medium, 100);
    Registration result;
    EmIcpResult em;
    Candidate winner; winner.distance = 1e30;
    for (std::size_t i=0;i<best.size();++i) {
        auto& c = best[i];
        if ((int)i < kFineCandidates) {
            EmIcpResult r = em_icp(thin_out(a, fine).points, fine_tree, c.motion, {.max_iterations = options.max_iterations});
            c.motion = r.motion;
            c.distance = pose_distance(c.motion, fine);
            if (!certain) c.distance = std::min(c.distance, pose_distance(c.motion, fine, -1.0));
            if (c.distance < winner.distance) { winner = c; em = r; }
        }
    }
    result.R = winner.motion.R;
    result.residual = winner.distance;
    result.scale = target_size.radius / source_size.radius;
    result.t = target_size.radius * winner.motion.t + target_size.centre - result.scale * result.R * source_size.centre;
    result.sigma = em.sigma * target_size.radius;
    result.iterations = em.iterations;
    result.converged = em.converged;
    result.runner_up = std::numeric_limits<double>::infinity();
    for (auto& c : best) if (distinct(c.motion, winner.motion)) result.runner_up = std::min(result.runner_up, c.distance);
    result.confident = result.runner_up > kConfidentRatio * result.residual;
    return result;
}

}  // namespace automorph
