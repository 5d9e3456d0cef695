#pragma once

#include <vector>

#include "morph/mesh/mesh.h"
#include "render/camera/camera.h"
#include "render/geometry/scene.h"

namespace automorph::render {

/// Axis-aligned box of one or more frames.
struct Bounds {
    Eigen::Vector3d lower{Eigen::Vector3d::Constant(1e300)};
    Eigen::Vector3d upper{Eigen::Vector3d::Constant(-1e300)};

    void add(const Points& V);  ///< rows that are not finite are left out
    Eigen::Vector3d center() const { return 0.5 * (lower + upper); }
    double radius() const { return 0.5 * (upper - lower).norm(); }
};

struct StudioOptions {
    Color background{0.93f, 0.93f, 0.93f};
    bool ground = true;  ///< a floor under the lowest point that shows the shadow only
};

/// The material of the figures: light warm-grey clay.
Material clay();

/// Lights a scene as the figures are: a soft key light from the upper left of the camera, a sky that fills
/// the shadows, a bright even background and, if wanted, a floor that shows nothing but the shadow.
/// @param bounds of all frames, so that one set-up serves a whole morph
/// @throws Error if the bounds are empty
void add_studio(Scene& scene, const Camera& camera, const Bounds& bounds, const StudioOptions& options = {});

}  // namespace automorph::render
