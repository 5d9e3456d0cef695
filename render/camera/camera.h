#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "render/math/ray.h"
#include "render/math/vec.h"

namespace automorph::render {

/// A camera with square pixels, pinhole or thin lens. World space is right-handed; units are the scene's.
struct Camera {
    Eigen::Vector3d position{0.0, -4.5, 1.0};
    Eigen::Vector3d target{0.0, 0.0, 0.0};  ///< the point in the middle of the picture
    Eigen::Vector3d up{0.0, 0.0, 1.0};      ///< any vector that is not along the view
    double vertical_fov = 30.0;             ///< degrees, in (0, 180)
    double lens_radius = 0.0;               ///< scene units; 0: a pinhole, all is sharp
    double focus_distance = 0.0;            ///< of the sharp plane, along the view; 0: that of the target
};

/// A camera for a picture of given size: rays through pixels, and points to pixels.
/// Pixel coordinates: x to the right, y downwards, pixel (i, j) covers [i, i+1] x [j, j+1].
class PictureCamera {
public:
    /// @throws ConfigError if the size is not positive, a number is not finite, the field of view is outside
    ///         (0, 180) degrees, position and target coincide, `up` is along the view or
    ///         the lens is negative
    PictureCamera(const Camera& camera, int width, int height);

    const Vec3& origin() const { return origin_; }
    Vec3 forward() const { return forward_.cast<float>(); }  ///< unit, the view

    /// Side of a pixel at distance 1 along the view.
    float pixel_size() const { return step_y_.norm(); }

    /// Whether rays start from more than one point.
    bool has_lens() const { return lens_radius_ > 0.0f; }

    /// The ray that leaves the lens at the place (u, v) in [0, 1)^2 and meets the sharp plane where the
    /// picture point (x, y) lies.
    Ray lens_ray(float x, float y, float u, float v) const;

    /// Unit direction of the ray from `origin()` through the picture point (x, y) in pixels.
    Vec3 direction(float x, float y) const {
        const Vec3 through = corner_ + x * step_x_ + y * step_y_;
        return 1.0f / std::sqrt(through.squaredNorm()) * through;
    }

    /// Picture point (pixels) of a world point; empty when it is not in front of the camera.
    std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const;

private:
    Eigen::Vector3d position_, right_, up_,
        forward_;  ///< right and up as long as half the picture at distance 1
    Vec3 origin_;
    Vec3 corner_, step_x_, step_y_;  ///< direction = corner + x step_x + y step_y, to be normalised
    Vec3 lens_right_, lens_up_;      ///< unit
    float lens_radius_, focus_distance_;
    double half_width_, half_height_;
};

}  // namespace automorph::render
