#pragma once

#include "morph/alignment/guide.h"
#include "morph/merge_disks.h"
#include "morph/merge_maps.h"
#include "morph/registration/registration.h"

namespace automorph {

struct SphereOptions {
    const Registration* registration = nullptr;  ///< brings the maps together; none: they stay as they are
    const Guide* guide = nullptr;                ///< where the vertices of a belong on b; comes after that
    bool moves_b = false;                        ///< the guide is b's: where its vertices belong on a
    bool curved = true;                          ///< placement of merged vertices
    std::uint64_t seed = 1;
};

/// Two closed shapes (openings filled) as one connectivity by way of the sphere: progressive embeddings,
/// alignment, overlay. Adds maps, alignment, overlay and stages to the report.
/// @throws InvalidMesh, SolverFailure  from the stages
MergedPair merge_spheres(const Shape& shape_a, const Shape& shape_b, const SphereOptions& options,
                         Report& report);

/// Two disks with a common border on the sphere: the border is locked on one circle of latitude.
MergedPair merge_locked_spheres(const Shape& shape_a, const Shape& shape_b, const BorderedDisks& disks,
                                const SphereOptions& options, Report& report);

}  // namespace automorph
