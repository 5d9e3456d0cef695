#pragma once

#include "render/camera/camera.h"
#include "render/figure/figure.h"

namespace automorph {

/// The two shapes of a figure.
struct ShapePair {
    InputMesh source, target;
};

/// The maps and features of a morph as small pictures for the page. Maps are drawn, a few milliseconds each;
/// pictures with features take as many pixels and samples as a cell at most.
/// @param camera  of the figure's cells: maps lie as it sees the source
/// @param morph   with its maps kept
MorphPanels morph_panels(const FigureConfig& config, const FigureOptions& options,
                         const render::Camera& camera, const ShapePair& shapes, const Morph& morph);

}  // namespace automorph
