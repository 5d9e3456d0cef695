#include "morph/export/animation.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "morph/mesh/geometry.h"

// Notation: a, b the ends relative to their centres c_a, c_b; R the rotation a -> b.

namespace automorph {

namespace {

// Keys of the parabolas of RigidLinear: the chord is within 1 / (2 n^2) of the curve.
constexpr int kParabolaSteps = 240;

using Shape = MorphAnimation::Shape;

Points relative(const Points& V, const Eigen::Vector3d& centre) {
    return V.rowwise() - centre.transpose();
}

/// @param shading  what smooth shading lacks (Endpoints), or empty
Shape shape(const Triangles& F, Points positions, const Points& shading) {
    Shape result{std::move(positions), {}};
    if (shading.rows() == 0) {
        result.normals = vertex_normals({result.positions, F});
    } else {
        result.normals = area_weighted_normals(result.positions, F) + shading;
        for (auto normal : result.normals.rowwise()) normal.stableNormalize();
    }
    return result;
}

/// A vertex whose triangles have no area has no normal: it takes that of `other`, else any.
void complete_normals(Shape& shape, const Shape& other) {
    for (Eigen::Index v = 0; v < shape.normals.rows(); ++v) {
        auto normal = shape.normals.row(v);
        if (normal.isZero(0.0)) normal = other.normals.row(v);
        if (normal.isZero(0.0)) normal = Eigen::RowVector3d::UnitZ();
    }
}

/// Steps of a turn: quarters of the way are among its keys.
int turn_steps(const Eigen::Matrix3d& R) {
    const double angle = Eigen::AngleAxisd(R).angle();
    return std::max(4, 4 * static_cast<int>(std::ceil(angle / kLargestTurn / 4.0)));
}

std::vector<MorphAnimation::Turn> turns(const Eigen::Matrix3d& R, double seconds) {
    std::vector<MorphAnimation::Turn> keys;
    const int steps = turn_steps(R);
    for (int k = 0; k <= steps; ++k) {
        const double alpha = static_cast<double>(k) / steps;
        Eigen::Quaterniond q(slerp(R, alpha));
        q.normalize();
        // q and -q are one rotation: neighbours of one sign keep players from the long way round.
        if (!keys.empty() && q.dot(keys.back().rotation) < 0.0) q.coeffs() = -q.coeffs();
        keys.push_back({alpha * seconds, q});
    }
    return keys;
}

/// Appends the way back, as long as the way there.
template <class Key>
void append_way_back(std::vector<Key>& keys, double seconds) {
    for (std::size_t k = keys.size(); k-- > 1;) {
        Key key = keys[k - 1];
        key.time = 2.0 * seconds - key.time;
        keys.push_back(std::move(key));
    }
}

}  // namespace

MorphAnimation animate(const Triangles& F, const Endpoints& ends, const AnimationOptions& options) {
    assert(ends.a.rows() == ends.b.rows());
    assert(options.seconds > 0.0);
    const bool parabolas = options.scheme == Interpolation::RigidLinear;
    const Eigen::Matrix3d R =
        options.scheme == Interpolation::Linear ? Eigen::Matrix3d(Eigen::Matrix3d::Identity()) : ends.R;
    const Points a = relative(ends.a, ends.centre_a), b = relative(ends.b, ends.centre_b);

    MorphAnimation result;
    result.offset = (0.5 * (ends.centre_a + ends.centre_b)).cast<float>().cast<double>();
    result.base = shape(F, a, ends.shading_a);
    if (parabolas) {
        result.targets = {shape(F, 0.5 * (a * R.transpose() + b * R),
                                0.5 * (ends.shading_a * R.transpose() + ends.shading_b * R)),
                          shape(F, b, ends.shading_b)};
    } else {
        result.targets = {shape(F, b * R, ends.shading_b * R)};  // row by row R^T b
        if (!R.isIdentity(0.0)) result.turns = turns(R, options.seconds);
    }
    complete_normals(result.base, result.targets.back());
    for (Shape& target : result.targets) complete_normals(target, result.base);

    const int steps = parabolas ? kParabolaSteps : 1;
    for (int k = 0; k <= steps; ++k) {
        const double alpha = static_cast<double>(k) / steps;
        MorphAnimation::Key key;
        key.time = alpha * options.seconds;
        key.translation = (1.0 - alpha) * ends.centre_a + alpha * ends.centre_b - result.offset;
        key.weights = parabolas ? std::vector<double>{2.0 * alpha * (1.0 - alpha), alpha * alpha}
                                : std::vector<double>{alpha};
        result.keys.push_back(std::move(key));
    }
    if (options.ping_pong) {
        append_way_back(result.turns, options.seconds);
        append_way_back(result.keys, options.seconds);
    }
    return result;
}

}  // namespace automorph
