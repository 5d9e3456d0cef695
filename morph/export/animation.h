#pragma once

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

#include "morph/interpolation/interpolation.h"
#include "morph/mesh/mesh.h"

namespace automorph {

struct AnimationOptions {
    Interpolation scheme = Interpolation::Slerp;
    double seconds = 2.0;    ///< from the source to the target, > 0
    bool ping_pong = false;  ///< and back to the source, as long again: a loop without a jump
};

/// A morph as scene formats play it: shapes that are blended by weights, and a node that turns and moves,
///
///     V(t) = offset + translation(t) + rotation(t) [ base + sum_k weight_k(t) (target_k - base) ]
///
/// with keys joined linearly, rotations by slerp. It is interpolate() of the same scheme at alpha = t /
/// seconds:
///
/// Slerp        Eq. (14): base a - c_a, one target R^T (b - c_b), rotation Slerp(1, R, alpha), weight alpha.
/// Linear       Eq. (12): the same with R = I.
/// RigidLinear  Eq. (13), the matrix (1 - alpha) I + alpha R, is no rotation that a node could have. But it
/// makes
///              V a quadratic Bezier curve in alpha, with the middle (R (a - c_a) + R^T (b - c_b)) / 2: a
///              second target. Its weights are parabolas, exact at the keys and within 1e-5 between them.
///
/// The translation is the centre's straight way from c_a to c_b in all three.
struct MorphAnimation {
    struct Shape {
        Points positions;  ///< #V x 3, relative to the centre, in scene units
        Points normals;    ///< #V x 3, unit length, smooth
    };
    struct Turn {
        double time = 0.0;  ///< seconds
        Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
    };
    struct Key {
        double time = 0.0;  ///< seconds
        Eigen::Vector3d translation = Eigen::Vector3d::Zero();
        std::vector<double> weights;  ///< one per target
    };

    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< halfway between the centres, rounded to float
    Shape base;
    std::vector<Shape> targets;
    std::vector<Turn> turns;  ///< of one sign, at most kLargestTurn apart; empty where nothing turns
    std::vector<Key> keys;
};

/// Radians between two keys of a rotation. Slerp needs no more than both ends, but Blender joins the
/// components of quaternions linearly: 1.5 degrees keep that within 1e-7 radians of slerp.
inline constexpr double kLargestTurn = 1.5 * std::numbers::pi / 180.0;

/// @pre options.seconds > 0, ends.R is a rotation
MorphAnimation animate(const Triangles& F, const Endpoints& ends, const AnimationOptions& options = {});

}  // namespace automorph
