#pragma once

#include "morph/cut/cut.h"
#include "morph/merge_disks.h"

namespace automorph {

/// One half of a closed shape that was cut, [Urtasun04] Sec. 6: its vertices are those of the shape, or lie
/// on edges of it where the plane crosses them. @param which  0 or 1
Disk disk_of(const CutMesh& cut_mesh, std::size_t which);

/// Both halves of a merged pair as one, closed along the border that they share, which the second runs
/// through the other way round.
MergedPair glued(const MergedPair& first, const MergedPair& second);

}  // namespace automorph
