#include "morph/parameterization/border_control.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <tuple>
#include <type_traits>
#include <utility>

#include "morph/mesh/geometry.h"
#include "morph/parameterization/border_union.h"

namespace automorph {

namespace {

/// Neighbours for responsibilities() to start with, and where to stop raising them.
constexpr int kFirstNeighbours = 16, kLastNeighbours = 1024;

/// The loop the other way round, first vertex kept.
int reversed_index(int index, int size) {
    return (size - index) % size;
}

Points reversed(const Points& loop) {
    const int n = static_cast<int>(loop.rows());
    Points other(n, 3);
    for (int k = 0; k < n; ++k) other.row(k) = loop.row(reversed_index(k, n));
    return other;
}

struct Pair {
    int source = -1, target = -1;  ///< loop indices
    double responsibility = 0.0, squared_distance = 0.0;

    bool better_than(const Pair& other) const {
        if (other.source < 0) return true;
        return std::tuple(-responsibility, squared_distance, source, target) <
               std::tuple(-other.responsibility, other.squared_distance, other.source, other.target);
    }
};

/// Best pair among the `neighbours` nearest of `candidates` for each source border vertex. `loop_index` says
/// which candidate is which border vertex of the target, -1 for none.
Pair best_pair(const Points& source_border, const Points& candidates, const std::vector<int>& loop_index,
               const Registration& registration, int neighbours) {
    const auto P = responsibilities(source_border, candidates, registration, neighbours);
    const Points moved = registration.apply(source_border);
    Pair best;
    for (int i = 0; i < P.outerSize(); ++i) {
        for (std::decay_t<decltype(P)>::InnerIterator it(P, i); it; ++it) {
            const int j = loop_index[static_cast<std::size_t>(it.col())];
            if (j < 0) continue;
            const Pair pair{i, j, it.value(), (moved.row(i) - candidates.row(it.col())).squaredNorm()};
            if (pair.better_than(best)) best = pair;
        }
    }
    return best;
}

/// The border pair with the largest p_ij.
Pair control_pair(const Points& source_border, const Mesh& target, const std::vector<int>& target_loop,
                  const Registration& registration) {
    std::vector<int> loop_index(static_cast<std::size_t>(target.vertex_count()), -1);
    for (std::size_t k = 0; k < target_loop.size(); ++k) {
        loop_index[static_cast<std::size_t>(target_loop[k])] = static_cast<int>(k);
    }
    for (int neighbours = kFirstNeighbours; neighbours <= kLastNeighbours; neighbours *= 4) {
        const Pair best = best_pair(source_border, target.V, loop_index, registration, neighbours);
        // Rows sum to 1 and are cut off behind their largest entries: none that is left out exceeds 1 /
        // neighbours.
        const bool complete = neighbours >= target.vertex_count() || best.responsibility * neighbours >= 1.0;
        if (best.source >= 0 && (complete || 4 * neighbours > kLastNeighbours)) return best;
    }
    // The borders lie apart: nearest border vertex of each, then the nearest pair.
    const Points target_border = loop_points(target, target_loop);
    Pair nearest;
    const auto P = responsibilities(source_border, target_border, registration, 1);
    const Points moved = registration.apply(source_border);
    for (int i = 0; i < P.outerSize(); ++i) {
        for (std::decay_t<decltype(P)>::InnerIterator it(P, i); it; ++it) {
            const Pair pair{i, static_cast<int>(it.col()), 0.0,
                            (moved.row(i) - target_border.row(it.col())).squaredNorm()};
            if (pair.better_than(nearest)) nearest = pair;
        }
    }
    if (nearest.source < 0) nearest.source = nearest.target = 0;
    return nearest;
}

/// C of Eq. (8): mean scalar product of corresponding border points.
double convolution(const Points& source, const Points& target, const BorderControl& control) {
    const BorderUnion u = border_union(source, target, control);
    double sum = 0.0;
    for (std::size_t k = 0; k < u.source.size(); ++k) {
        sum += position(source, u.source[k]).dot(position(target, u.target[k]));
    }
    return sum / u.size();
}

}  // namespace

BorderControl registered_control(const Mesh& source, const std::vector<int>& source_loop, const Mesh& target,
                                 const std::vector<int>& target_loop, const Registration& registration) {
    const Points source_border = loop_points(source, source_loop),
                 target_border = loop_points(target, target_loop);
    const Pair pair = control_pair(source_border, target, target_loop, registration);
    BorderControl control;
    control.source = pair.source;
    control.target = pair.target;
    control.responsibility = pair.responsibility;

    // Positions about the centre of mass, the source turned and scaled into the target's frame.
    const Points a = (source_border.rowwise() - centre_of_mass(source).transpose()) *
                     (registration.scale * registration.R.transpose());
    const Points b = target_border.rowwise() - centre_of_mass(target).transpose();
    BorderControl backwards = control;
    backwards.target = reversed_index(control.target, static_cast<int>(target_loop.size()));
    control.convolution = convolution(a, b, control);
    control.convolution_reversed = convolution(a, reversed(b), backwards);
    if (control.convolution_reversed > control.convolution) {
        std::swap(control.convolution, control.convolution_reversed);
        control.target_reversed = true;
    }
    return control;
}

ReversedTarget reversed_target(const Mesh& target, const std::vector<int>& loop,
                               const BorderControl& control) {
    ReversedTarget reversed{target, loop, control};
    reversed.mesh.F.col(1).swap(reversed.mesh.F.col(2));
    std::reverse(reversed.loop.begin() + 1, reversed.loop.end());
    reversed.control.target = reversed_index(control.target, static_cast<int>(loop.size()));
    reversed.control.target_reversed = false;
    return reversed;
}

}  // namespace automorph
