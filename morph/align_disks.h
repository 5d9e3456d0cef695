#pragma once

#include <string>
#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/report.h"

namespace automorph {

/// A disk on its map, as the curvature adjustment takes it.
struct DiskToAlign {
    const Mesh& mesh;
    const std::vector<int>& loop;      ///< its border
    const std::vector<char>& filling;  ///< per triangle: it fills an opening and has no curvature of its own
    Points& rays;                      ///< #V x 3 registered map (x, y, 1), warped in place
};

/// The curvature adjustment of [Urtasun04] Sec. 4.3 between maps and overlay. Adds what was found to the
/// report, and a note if features did not get to their places.
/// @param label  tells the disks of one morph apart in the report
void align_disks(DiskToAlign a, DiskToAlign b, const std::string& label, Report& report);

}  // namespace automorph
