#pragma once

#include <string>
#include <vector>

#include "morph/overlay/overlay.h"
#include "morph/parameterization/border.h"
#include "morph/report.h"
#include "morph/stage_clock.h"

namespace automorph {

/// One of the two shapes of a morph: where merged vertices are placed.
struct Shape {
    Mesh mesh;       ///< openings filled
    Points normals;  ///< #V x 3 unit vertex normals of the unfilled surface; zero at the centres of fillings
    int own_vertices;  ///< vertices beyond these are centres of fillings
};

/// A disk of a shape: the whole of an open one, or one half of a closed one.
struct Disk {
    Mesh mesh;
    std::vector<int> loop;    ///< its border
    std::vector<Site> sites;  ///< per vertex: where it lies on the shape
};

/// Two disks with one connectivity.
struct MergedDisks {
    Triangles F;                   ///< merged triangles
    std::vector<Site> on_a, on_b;  ///< per merged vertex: its place on shape a, on shape b
    std::vector<int> border;       ///< merged vertices of the border, counter-clockwise; [k] is the union's k
    std::vector<char> in_filling;  ///< per merged triangle: it lies in a filled opening of either shape
};

struct MergeOptions {
    bool curved = true;           ///< merged vertices on the curved surface, Eq. (9)-(11)
    bool align_features = false;  ///< Sec. 4.3: the maps are warped before they are overlaid
};

/// Merged vertices at their places on a shape, #sites x 3: curved by Eq. (9)-(11), or on the flat facets.
Points place_on(const Shape& shape, const std::vector<Site>& sites, bool curved);

/// [Urtasun04] Sec. 3 for two disks whose borders are known to correspond: border insertion, maps, features
/// if asked for, overlay, triangulation. Adds its maps, overlay and stages to the report.
/// @param label  " half 1" or "": tells the disks of one morph apart in the report
/// @throws SolverFailure a stage found no valid answer
MergedDisks merge_disks(const Shape& shape_a, const Disk& a, const Shape& shape_b, const Disk& b,
                        const BorderUnion& border, const MergeOptions& options, const std::string& label,
                        Report& report);

}  // namespace automorph
