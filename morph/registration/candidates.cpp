#include "morph/registration/candidates.h"

#include <algorithm>
#include <cassert>
#include <numbers>

namespace automorph {

namespace {

constexpr double kDistinctAngle = 15.0 * std::numbers::pi / 180.0;
constexpr double kTieRatio = 1.15;

bool better(const Candidate& a, const Candidate& b) {
    return a.distance < b.distance;
}

}  // namespace

bool distinct(const RigidMotion& a, const RigidMotion& b) {
    return rotation_angle(a.R * b.R.transpose()) > kDistinctAngle;
}

std::vector<Candidate> best_distinct(std::vector<Candidate> candidates) {
    std::stable_sort(candidates.begin(), candidates.end(), better);
    std::vector<Candidate> best;
    for (const Candidate& candidate : candidates) {
        const auto differs = [&](const Candidate& other) { return distinct(candidate.motion, other.motion); };
        if (std::all_of(best.begin(), best.end(), differs)) best.push_back(candidate);
    }
    return best;
}

std::vector<Candidate> promising(const std::vector<Candidate>& best_first, std::size_t most, double ratio) {
    std::vector<Candidate> kept;
    for (const Candidate& candidate : best_first) {
        if (kept.size() == most || candidate.distance > ratio * best_first.front().distance) break;
        kept.push_back(candidate);
    }
    return kept;
}

std::size_t least_turn_among_best(const std::vector<Candidate>& candidates) {
    assert(!candidates.empty());
    const double tie = kTieRatio * std::min_element(candidates.begin(), candidates.end(), better)->distance;
    std::size_t choice = candidates.size();
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        if (candidates[i].distance > tie) continue;
        if (choice == candidates.size() ||
            rotation_angle(candidates[i].motion.R) < rotation_angle(candidates[choice].motion.R)) {
            choice = i;
        }
    }
    return choice;
}

}  // namespace automorph
