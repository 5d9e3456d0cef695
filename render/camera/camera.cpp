#include "render/camera/camera.h"

#include <fmt/format.h>

#include <cmath>

#include "morph/mesh/errors.h"
#include "render/math/angle.h"
#include "render/math/disk.h"

namespace automorph::render {
namespace {

constexpr double kLeastSine = 1e-6;  // between view and up: below, the horizon is not defined

}  // namespace

PictureCamera::PictureCamera(const Camera& camera, int width, int height) : position_(camera.position) {
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
    if (!(camera.lens_radius >= 0.0 && std::isfinite(camera.lens_radius) && camera.focus_distance >= 0.0 &&
          std::isfinite(camera.focus_distance))) {
        throw ConfigError(fmt::format("camera: lens radius {} and focus distance {}; neither may be negative",
                                      camera.lens_radius, camera.focus_distance));
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
    lens_right_ = right.cast<float>();
    lens_up_ = (up_ / half).cast<float>();
    lens_radius_ = static_cast<float>(camera.lens_radius);
    focus_distance_ = static_cast<float>(camera.focus_distance > 0.0 ? camera.focus_distance : view.norm());
}

Ray PictureCamera::lens_ray(float x, float y, float u, float v) const {
    const Vec3 sharp = focus_distance_ * (corner_ + x * step_x_ + y * step_y_);  // from the lens's middle
    const Eigen::Vector2f disk = lens_radius_ * sample_disk(u, v);
    const Vec3 start = disk.x() * lens_right_ + disk.y() * lens_up_;
    return {origin_ + start, (sharp - start).normalized()};
}

std::optional<Eigen::Vector2d> PictureCamera::project(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d d = point - position_;
    const double depth = d.dot(forward_);
    if (!(depth > 0.0)) return std::nullopt;
    const double x = d.dot(right_) / (right_.squaredNorm() * depth);
    const double y = d.dot(up_) / (up_.squaredNorm() * depth);
    return Eigen::Vector2d(half_width_ * (1.0 + x), half_height_ * (1.0 - y));
}

}  // namespace automorph::render
