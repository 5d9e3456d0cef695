#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/compare/statistical.h"
#include "render/figure/subject.h"
#include "tests/render/compare/power_changes.h"

namespace automorph::bench {

/// What a cell of a golden figure shows, to be rendered with changes.
struct GoldenScene {
    std::string name;  ///< e.g. "fig7 row2-col3"
    PictureConfig picture;
    Mesh mesh;
    render::Camera camera;
    render::Bounds bounds;  ///< of all that the figure's camera frames
    int width = 0, height = 0, spp = 0;
    std::string embree_config;
    int vertex = -1;       ///< the one that changes are about, seen in the middle third of the picture
    double ring_area = 0;  ///< of the triangles at it as the camera sees them, pixels

    bool smooth() const { return picture.normals == render::Normals::Smooth; }
};

/// The middle cell of the last row of a golden figure; of the materials, all cells. Of figures that draw on
/// path-traced pictures, the picture below; none of those that are only drawn.
/// @throws Error if a cell rendered from here is not bit by bit what render_figure() makes
std::vector<GoldenScene> golden_scenes(const std::string& figure);

/// @pre scene.vertex is set, or the change needs none
render::NoisyImage render_changed(const GoldenScene& scene, power::Change change, int spp,
                                  std::uint64_t seed);

}  // namespace automorph::bench
