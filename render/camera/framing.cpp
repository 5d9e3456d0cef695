#include "render/camera/framing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "morph/mesh/errors.h"
#include "render/math/angle.h"

namespace automorph::render {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();
constexpr double kLeastDistance = 0.01;  // of the nearest point, in depths of the shape
constexpr double kRounding = 1e-12;      // relative to the coordinates
// Of the shape from its camera. Beyond, floats do not hold squares of areas: there are holes, and no ground.
constexpr double kNearestShape = 1e-10, kFarthestShape = 1e8;

/// The least value of functional . p while p turns. With p = foot on the axis + r, that is functional . foot
/// + A cos(phi) + B sin(phi), A = functional . r and B = functional . (axis x r): least at the ends, or
/// opposite to the angle of (A, B) if the turn comes there.
class LeastInSweep {
public:
    explicit LeastInSweep(const Sweep& sweep)
        : point_(sweep.point),
          axis_(sweep.axis.normalized()),
          from_(std::min(sweep.from, sweep.to) * kRadians),
          length_(std::abs(sweep.to - sweep.from) * kRadians),
          is_whole_(length_ >= kTurn) {}

    double operator()(const Eigen::Vector3d& functional, const Eigen::Vector3d& p) const {
        const Eigen::Vector3d d = p - point_;
        const Eigen::Vector3d foot = d.dot(axis_) * axis_, r = d - foot;
        const double a = functional.dot(r), b = functional.dot(cross(axis_, r));
        const double middle = functional.dot(point_ + foot), amplitude = std::hypot(a, b);
        if (is_whole_) return middle - amplitude;
        double to_least = std::remainder(std::atan2(b, a) + 0.5 * kTurn - from_, kTurn);
        if (to_least < 0.0) to_least += kTurn;
        if (to_least <= length_) return middle - amplitude;
        const auto at = [&](double phi) { return middle + a * std::cos(phi) + b * std::sin(phi); };
        return std::min(at(from_), at(from_ + length_));
    }

private:
    static constexpr double kTurn = 360.0 * kRadians;
    Eigen::Vector3d point_, axis_;
    double from_, length_;
    bool is_whole_;
};

}  // namespace

// Notation: camera at c with axes r, u, f (right, up, forward), X = p.r and so on for a point p, cx = c.r
// ...; s, t the tangents of half the free picture. p is inside if |X - cx| <= s (Z - cz) and |Y - cy| <= t (Z
// - cz): four planes. With A1 = min(s Z - X), A2 = min(s Z + X): s cz - cx <= A1 and s cz + cx <= A2, so cz
// <= (A1 + A2) / 2s, there cx = (A2 - A1) / 2; likewise in Y.

Framing::Framing(const FramingOptions& options)
    : options_(options),
      min_right_(kUnbounded),
      min_left_(kUnbounded),
      min_top_(kUnbounded),
      min_bottom_(kUnbounded),
      nearest_(kUnbounded),
      farthest_(-kUnbounded) {
    if (!(options.aspect > 0.0) || !std::isfinite(options.aspect)) {
        throw ConfigError(fmt::format("framing: the aspect is {}; it must be positive", options.aspect));
    }
    if (!(options.margin >= 0.0 && options.margin < 1.0)) {
        throw ConfigError(fmt::format("framing: the margin is {}; it must be in [0, 1)", options.margin));
    }
    Camera probe;
    probe.position.setZero();
    probe.target = options.direction;
    probe.up = options.up;
    probe.vertical_fov = options.vertical_fov;
    PictureCamera(probe, 1, 1);  // throws for what is not a camera

    forward_ = options.direction.normalized();
    right_ = cross(forward_, options.up).normalized();
    up_ = cross(right_, forward_);
    tan_y_ = std::tan(0.5 * options.vertical_fov * kRadians) * (1.0 - options.margin);
    tan_x_ = tan_y_ * options.aspect;
}

void Framing::add(const Points& V) {
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        if (!V.row(i).allFinite()) continue;
        const Eigen::Vector3d p = V.row(i);
        const double x = p.dot(right_), y = p.dot(up_), z = p.dot(forward_);
        min_right_ = std::min(min_right_, tan_x_ * z - x);
        min_left_ = std::min(min_left_, tan_x_ * z + x);
        min_top_ = std::min(min_top_, tan_y_ * z - y);
        min_bottom_ = std::min(min_bottom_, tan_y_ * z + y);
        nearest_ = std::min(nearest_, z);
        farthest_ = std::max(farthest_, z);
    }
}

void Framing::add(const Points& V, const Sweep& sweep) {
    const LeastInSweep least(sweep);
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        if (!V.row(i).allFinite()) continue;
        const Eigen::Vector3d p = V.row(i);
        min_right_ = std::min(min_right_, least(tan_x_ * forward_ - right_, p));
        min_left_ = std::min(min_left_, least(tan_x_ * forward_ + right_, p));
        min_top_ = std::min(min_top_, least(tan_y_ * forward_ - up_, p));
        min_bottom_ = std::min(min_bottom_, least(tan_y_ * forward_ + up_, p));
        nearest_ = std::min(nearest_, least(forward_, p));
        farthest_ = std::max(farthest_, -least(-forward_, p));
    }
}

Camera Framing::camera() const {
    if (!(nearest_ <= farthest_)) throw Error("framing: no finite point to frame");
    const double z =
        std::min((min_right_ + min_left_) / (2.0 * tan_x_), (min_top_ + min_bottom_) / (2.0 * tan_y_));
    const double x = 0.5 * (min_left_ - min_right_);
    const double y = 0.5 * (min_bottom_ - min_top_);
    const double middle = 0.5 * (nearest_ + farthest_);
    double back = std::min(z, nearest_ - kLeastDistance * (farthest_ - nearest_));
    const double size = std::max({std::abs(x), std::abs(y), std::abs(middle)});
    if (!(middle - back > kRounding * size))
        back = middle - (size > 0.0 ? size : 1.0);  // all points coincide
    if (const double distance = middle - back; !(distance >= kNearestShape && distance <= kFarthestShape)) {
        throw Error(fmt::format(
            "the shape is too {} for a picture: its camera would be {:.1g} units away, which must "
            "be within {:g} and {:g}; give the mesh in another unit",
            distance < 1.0 ? "small" : "large", distance, kNearestShape, kFarthestShape));
    }

    Camera camera;
    camera.position = x * right_ + y * up_ + back * forward_;
    camera.target = camera.position + (middle - back) * forward_;
    camera.up = options_.up;
    camera.vertical_fov = options_.vertical_fov;
    return camera;
}

Camera frame_all(const std::vector<Points>& frames, const FramingOptions& options) {
    Framing framing(options);
    for (const Points& frame : frames) framing.add(frame);
    return framing.camera();
}

}  // namespace automorph::render
