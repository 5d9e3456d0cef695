#pragma once

#include "render/figure/config.h"
#include "render/figure/figure.h"

namespace automorph::program {

/// How many pictures a figure has.
struct PictureCounts {
    std::size_t rows = 0, columns = 0;  ///< of cells
    int stills = 0;                     ///< rendered per row's video; the way back shows them again
    int turntable = 0;                  ///< frames
};

/// Seconds of each stage, as a run tells them at its end; `checks` with the drawings of maps and features.
struct Estimate {
    double meshes = 0, morphs = 0, checks = 0, pictures = 0, videos = 0;

    double whole() const { return meshes + morphs + checks + pictures + videos; }
};

/// About how long making a figure takes: light paths and the denoiser are measured on this machine, for a
/// fraction of a second; all else goes by the number of triangles.
/// @throws IoError, InvalidMesh if a mesh file of the config cannot be used
Estimate estimate(const FigureConfig& config, const FigureOptions& options, const PictureCounts& counts);

}  // namespace automorph::program
