#pragma once

#include <string>
#include <vector>

#include "morph/features/align.h"
#include "morph/merge_maps.h"
#include "morph/report.h"

namespace automorph {

/// A disk on its registered map, as the curvature adjustment takes it.
struct DiskToAlign {
    MappedPart& disk;                  ///< its map is warped in place
    const std::vector<char>& filling;  ///< per triangle: it fills an opening and has no curvature of its own
};

/// The curvature adjustment of [Urtasun04] Sec. 4.3 between maps and overlay. Adds what was found to the
/// report, and a note if features did not get to their places.
/// @param label  tells the disks of one morph apart in the report
void align_disks(DiskToAlign a, DiskToAlign b, const AlignOptions& options, const std::string& label,
                 Report& report);

}  // namespace automorph
