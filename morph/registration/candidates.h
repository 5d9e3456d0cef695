#pragma once

#include <vector>

#include "morph/registration/procrustes.h"

namespace automorph {

/// A pose and how badly the two shapes agree in it.
struct Candidate {
    RigidMotion motion;
    double distance = 0.0;
};

/// True if two poses are more than 15 degrees apart; closer ones count as one pose, found twice.
bool distinct(const RigidMotion& a, const RigidMotion& b);

/// Best first, and of each pose only the best.
std::vector<Candidate> best_distinct(std::vector<Candidate> candidates);

/// Those worth refining: at most `most`, none worse than `ratio` times the best, but at least two (if there
/// are).
/// @param best_first  as best_distinct gives them
std::vector<Candidate> promising(const std::vector<Candidate>& best_first, std::size_t most, double ratio);

/// The candidate to take: the one that turns least among those that tie with the best. Ties are within a
/// factor of 1.15 in the distance: shape cannot tell them apart, as it is symmetric or differs by more than
/// the poses do; files are more often than not in similar poses, and a morph should not turn without need.
/// @returns its index; candidates must not be empty
std::size_t least_turn_among_best(const std::vector<Candidate>& candidates);

}  // namespace automorph
