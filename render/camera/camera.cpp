#include "render/camera/camera.h"

#include <fmt/format.h>

#include <cmath>

#include "morph/mesh/errors.h"

namespace automorph::render {
namespace {

constexpr double kRadians = 3.14159265358979324 / 180.0;
constexpr double kLeastSine = 1e-6;  // between view and up: below, the horizon is not defined

}  // namespace

PinholeCamera::PinholeCamera(const Camera& camera, int width, int height) : position_(camera.position) {
    if (width <= 0 || height <= 0) {
        throw ConfigError(
            fmt::format("camera: the picture is {} x {} pixels; give positive sizes", width, height));
    }
    if (!camera.position.allFinite() || !camera.target.allFinite() || !camera.up.allFinite()) {
        throw ConfigError("camera: position, target or up is not finite");
    }
    if (!(camera.vertical_fov > 0.0 && camera.vertical_fov < 180.0)) {
        throw ConfigError(
            fmt::format("camera: the vertical field of view is {} degrees; it must be between 0 and 180",
                        camera.vertical_fov));
    }
    const Eigen::Vector3d view = camera.target - camera.position;
    if (view.norm() == 0.0) throw ConfigError("camera: position and target are the same point");
    forward_ = view.normalized();
    const Eigen::Vector3d side = cross(forward_, camera.up);
    if (!(side.norm() > kLeastSine * camera.up.norm())) {
        throw ConfigError("camera: the up vector is zero or along the view; give another one");
    }
    half_width_ = 0.5 * width;
    half_height_ = 0.5 * height;
    const double half = std::tan(0.5 * camera.vertical_fov * kRadians);
    const Eigen::Vector3d right = side.normalized();
    up_ = half * cross(right, forward_);
    right_ = half * width / height * right;

    origin_ = position_.cast<float>();
    corner_ = (forward_ - right_ + up_).cast<float>();
    step_x_ = (right_ / half_width_).cast<float>();
    step_y_ = (-up_ / half_height_).cast<float>();
}

std::optional<Eigen::Vector2d> PinholeCamera::project(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d d = point - position_;
    const double depth = d.dot(forward_);
    if (!(depth > 0.0)) return std::nullopt;
    const double x = d.dot(right_) / (right_.squaredNorm() * depth);
    const double y = d.dot(up_) / (up_.squaredNorm() * depth);
    return Eigen::Vector2d(half_width_ * (1.0 + x), half_height_ * (1.0 - y));
}

}  // namespace automorph::render
