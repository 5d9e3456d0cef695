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

/// What a shape stands on: a floor just under its lowest point.
enum class Ground {
    None,
    Shadow,  ///< shows nothing but the shadow, on the background
    Plain,   ///< a sheet of paper, under studio lights rising behind the shape without a seam
    Checker  ///< the same with squares, which show scale and reflections
};

struct StudioOptions {
    /// Radiance of what the camera sees where nothing stands; a ground that is seen itself has four fifths of
    /// it as albedo.
    Color background{0.93f, 0.93f, 0.93f};
    Ground ground = Ground::Shadow;
    /// Strength of a light from behind, above right, relative to the key: it draws the outline of dark and
    /// shining materials. None by default, since it casts a shadow of its own towards the camera.
    float rim = 0.0f;
    float strength = 1.0f;  ///< factor on all lights
};

/// The material of the figures: light warm-grey clay.
Material clay();

/// Lights a scene as the figures are: a soft key light from the upper left of the camera, a sky that fills
/// the shadows, a bright even background and, if wanted, a floor.
/// @param bounds of all frames, so that one set-up serves a whole morph
/// @throws Error if the bounds are empty
void add_studio(Scene& scene, const Camera& camera, const Bounds& bounds, const StudioOptions& options = {});

/// The floor alone, for scenes under a sky: as large as one sees, level, without a wall behind.
/// @throws Error if the bounds are empty
void add_ground(Scene& scene, const Camera& camera, const Bounds& bounds, Ground ground,
                const Color& background);

}  // namespace automorph::render
