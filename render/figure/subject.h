#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "render/camera/camera.h"
#include "render/camera/framing.h"
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
    double adaptive_error = 0;  ///< render::RenderOptions; 0: all pixels take `spp`
    int time_steps = 1;         ///< of an exposure: render::shutter_steps()
    std::shared_ptr<const render::EquirectangularMap> sky;  ///< null without a picture of one

    /// That a picture takes at most.
    double samples() const { return static_cast<double>(width) * height * spp; }
};

/// Size and samples of pictures.
struct Film {
    int width = 0, height = 0, spp = 0;
};

/// Finds the tightest camera of the config's direction for all frames, and their bounds. Frames are not kept.
class ShootingPlan {
public:
    ShootingPlan(const PictureConfig& picture, const FigureOptions& options, const Film& film);
    void add(const Points& V);
    Shooting shooting() const;

private:
    const PictureConfig& picture_;
    const FigureOptions& options_;
    Film film_;
    render::Framing framing_;
    render::Bounds bounds_;
};

/// The same in one call.
Shooting shooting_of(const PictureConfig& picture, const FigureOptions& options, const Film& film,
                     const std::vector<const Points*>& frames);

/// Points turned about an axis through `centre`.
Points turned(const Points& V, const Eigen::RowVector3d& centre, const Eigen::Vector3d& axis, double degrees);

/// The surface of the config. @param width  pixels of the picture: the edges' width follows it
render::Material material_of(const PictureConfig& picture, int width);

/// A surface in the figure's light.
class Subject {
public:
    Subject(const Shooting& shooting, const Points& V, const Triangles& F);

    /// Colours the surface by a scalar per vertex from now on.
    void color(const Eigen::VectorXd& values, const ColorScale& scale);

    /// What smooth shading of the next picture lacks at each time step, #V x 3, as Morph::shading().
    void correct_normals(const std::vector<Points>& steps);

    /// Puts small spheres on vertices of the surface, which go along with it.
    void mark(const std::vector<int>& vertices);

    /// Moves the vertices there and takes the picture.
    /// @param frame  of a video: frames have independent noise
    FigureCell shoot(const Points& V, const std::function<void(double)>& progress, std::uint32_t frame = 0);

    /// The same with the vertices at each time step of the exposure.
    FigureCell shoot(const std::vector<Points>& steps, const std::function<void(double)>& progress,
                     std::uint32_t frame = 0);

    /// Whether the camera sees a point of the surface as it was last pictured.
    bool sees(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const;

private:
    const Shooting& shooting_;
    render::Scene scene_;
    int mesh_;
    std::optional<Markers> markers_;
};

}  // namespace automorph
