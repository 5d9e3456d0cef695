#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "morph/mesh/mesh.h"
#include "render/camera/camera.h"
#include "render/geometry/scene.h"
#include "render/integrator/render.h"
#include "render/studio/studio.h"
#include "render/turntable/timeline.h"

namespace automorph::turntable {

/// What turns: one connectivity, vertices per alpha (#V x 3, any position and unit).
struct Shape {
    Triangles triangles;
    std::function<Points(double alpha)> vertices;
    std::function<Points(double alpha)> shading =
        {};  ///< what smooth shading lacks (Scene::correct_normals), optional
};

struct StageOptions {
    Eigen::Vector3d up{0, 0, 1};    ///< of the shape's coordinates: what stands upright
    Eigen::Vector3d view{0, 1, 0};  ///< likewise: where the camera looks at 0 degrees; its part along `up` is
                                    ///< left out
    double elevation = 14;          ///< degrees the camera looks downwards, in [0, 90)
    double fov = 20;                ///< vertical field of view, degrees
    double margin = 0.06;           ///< free on each side, fraction of half the picture
    render::Normals normals = render::Normals::Smooth;
    int width = 640, height = 640, spp = 64;
    std::uint64_t seed = 1;     ///< of the noise, which differs from frame to frame
    int threads = 0;            ///< 0: all
    std::string embree_config;  ///< SceneOptions
};

/// @throws ConfigError if an option is out of range, or `view` is along `up`
void check(const StageOptions& options);

/// A shape on a turntable.
///
/// World coordinates: the axis is z, through the middle of the box around all shapes; each shape stands on
/// the floor z = 0. The shape keeps its place, and camera and lights go round it the other way: the picture
/// of a shape that turns under fixed light, but the tree over its triangles is built once and not per frame,
/// and is the same whichever frame comes first. While the shutter is open, it is the shape that moves.
class Stage {
public:
    /// @param frames  of the whole sequence, with equally many steps: one camera distance holds for all of
    /// them
    /// @throws ConfigError as check() does, or if there are no frames
    /// @throws Error       if the shape has no finite vertex
    Stage(Shape shape, const std::vector<Exposure>& frames, const StageOptions& options);

    /// Takes the picture. @param frame  chooses the noise
    /// @pre as many steps as the frames given at first have
    render::RenderResult picture(const Exposure& exposure, int frame,
                                 const std::function<void(double)>& progress = {});

    /// Light paths of a picture.
    double samples() const;

    /// The camera that sees the shape turned by so many degrees, in world coordinates.
    render::Camera camera(double degrees) const;

    /// The vertices of an in-between, in world coordinates, not turned.
    Points standing(double alpha) const;

private:
    void place_axis(const std::vector<Exposure>& frames);
    void frame(const std::vector<Exposure>& frames);
    void furnish();
    void show(const std::vector<Moment>& steps);
    Points upright(double alpha) const;

    Shape shape_;
    StageOptions options_;
    Eigen::Matrix3d to_world_;                        ///< rows: right, level view, up of the shape
    Eigen::Vector3d axis_ = Eigen::Vector3d::Zero();  ///< foot of the axis in coordinates turned by to_world_
    render::Camera camera_;                           ///< at 0 degrees
    render::Bounds bounds_;                           ///< of all turns
    std::vector<render::RectangleLight> lights_;      ///< at 0 degrees
    render::Scene scene_;
    int mesh_ = -1;
    std::vector<Moment> shown_;  ///< degrees from those of the picture's middle
};

}  // namespace automorph::turntable
