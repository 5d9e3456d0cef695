#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "render/camera/camera.h"
#include "render/figure/color_field.h"
#include "render/figure/config.h"
#include "render/figure/figure.h"
#include "render/figure/markers.h"
#include "render/geometry/scene.h"
#include "render/light/equirectangular_map.h"
#include "render/studio/studio.h"

namespace automorph {

/// How the cells of a figure are pictured.
struct Shooting {
    const PictureConfig& picture;
    const FigureOptions& options;
    render::Camera camera;
    render::Bounds bounds;  ///< of all that is ever shown
    int width = 0, height = 0, spp = 0;
    std::shared_ptr<const render::EquirectangularMap> sky;  ///< null without a picture of one
};

/// The tightest camera of the config's direction for all frames, and their bounds.
Shooting shooting_of(const PictureConfig& picture, const FigureOptions& options, const Figure& figure,
                     const std::vector<const Points*>& frames);

/// A surface in the figure's light.
class Subject {
public:
    Subject(const Shooting& shooting, const Points& V, const Triangles& F);

    /// Colours the surface by a scalar per vertex from now on.
    void color(const Eigen::VectorXd& values, const ColorScale& scale);

    /// Puts small spheres on vertices of the surface, which go along with it.
    void mark(const std::vector<int>& vertices);

    /// Moves the vertices there and takes the picture.
    FigureCell shoot(const Points& V, const std::function<void(double)>& progress);

    /// Whether the camera sees a point of the surface as it was last pictured.
    bool sees(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

private:
    const Shooting& shooting_;
    render::Scene scene_;
    int mesh_;
    std::optional<Markers> markers_;
};

}  // namespace automorph
