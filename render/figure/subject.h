#pragma once

#include <functional>

#include "render/camera/camera.h"
#include "render/figure/config.h"
#include "render/figure/figure.h"
#include "render/geometry/scene.h"
#include "render/studio/studio.h"

namespace automorph {

/// How the cells of a figure are pictured.
struct Shooting {
    const PictureConfig& picture;
    const FigureOptions& options;
    render::Camera camera;
    render::Bounds bounds;  ///< of all that is ever shown
    int width = 0, height = 0, spp = 0;
};

/// The tightest camera of the config's direction for all frames, and their bounds.
Shooting shooting_of(const PictureConfig& picture, const FigureOptions& options, const Figure& figure,
                     const std::vector<const Points*>& frames);

/// A surface in the figure's light.
class Subject {
public:
    Subject(const Shooting& shooting, const Points& V, const Triangles& F);

    /// Moves the vertices there and takes the picture.
    FigureCell shoot(const Points& V, const std::function<void(double)>& progress);

    /// Whether the camera sees a point of the surface as it was last pictured.
    bool sees(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

private:
    const Shooting& shooting_;
    render::Scene scene_;
    int mesh_;
};

}  // namespace automorph
