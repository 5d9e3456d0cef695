#pragma once

#include <vector>

#include "morph/morph.h"
#include "render/figure/config.h"
#include "render/geometry/scene.h"
#include "render/geometry/spheres.h"

namespace automorph {

/// Vertices of the merged mesh that a config marks, by way of the source's vertices they are.
/// @param source  as given to the morph
/// @param ends    of the morph, #V x 3 at alpha = 0
std::vector<int> marked_vertices(const MarkersConfig& config, const Points& source, const Points& ends,
                                 const std::vector<FeatureReport>& features);

/// `count` rows of V, each as far from those before it as can be, the first one the farthest from the middle;
/// fewer where V has fewer different ones.
std::vector<int> farthest_vertices(const Points& V, int count);

/// Small spheres on vertices of a surface, in distinct colours.
class Markers {
public:
    /// Adds them to the scene.
    /// @param radius      scene units
    /// @param time_steps  of the exposure
    Markers(render::Scene& scene, std::vector<int> vertices, double radius, int time_steps = 1);

    /// Brings them to where the surface's vertices are at each time step.
    void move(render::Scene& scene, const std::vector<Points>& steps);

private:
    std::vector<int> vertices_;
    double radius_;
    render::Sphere sphere_;
    int mesh_ = -1;  ///< none without vertices
};

}  // namespace automorph
