#include "morph/align_disks.h"

#include <fmt/format.h>

#include "morph/features/align.h"
#include "morph/merge_maps.h"
#include "morph/stage_clock.h"

namespace automorph {

void align_disks(DiskToAlign a, DiskToAlign b, const std::string& label, Report& report) {
    const StageClock clock(report, "features" + label);
    const Triangles surface_a = without_fillings(a.mesh.F, a.filling),
                    surface_b = without_fillings(b.mesh.F, b.filling);
    AlignedMaps aligned =
        align_features({a.mesh, surface_a, a.loop, a.rays}, {b.mesh, surface_b, b.loop, b.rays});
    a.rays = std::move(aligned.rays_a);
    b.rays = std::move(aligned.rays_b);
    const auto matched = static_cast<int>(aligned.matches.size());
    report.features.push_back({.candidates_a = aligned.candidates_a,
                               .candidates_b = aligned.candidates_b,
                               .matched = matched,
                               .in_place = aligned.in_place,
                               .warps = aligned.warps,
                               .rounds = aligned.rounds,
                               .distance_before = aligned.distance_before,
                               .distance_after = aligned.distance_after});
    if (aligned.in_place < matched) {
        report.notes.push_back(
            fmt::format("{} of {} matched features{} lie on one another; more would fold a map",
                        aligned.in_place, matched, label));
    }
}

}  // namespace automorph
