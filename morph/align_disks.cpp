#include "morph/align_disks.h"

#include <fmt/format.h>

#include "morph/stage_clock.h"

namespace automorph {

namespace {

/// Features are inner vertices, and those are vertices of the shape.
int on_shape(const MappedPart& disk, int vertex) {
    return disk.sites[static_cast<std::size_t>(vertex)].corners[0];
}

std::vector<int> on_shape(const MappedPart& disk, std::vector<int> vertices) {
    for (int& v : vertices) v = on_shape(disk, v);
    return vertices;
}

}  // namespace

void align_disks(DiskToAlign a, DiskToAlign b, const AlignOptions& options, const std::string& label,
                 Report& report) {
    const StageClock clock(report, "features" + label);
    const Triangles surface_a = without_fillings(a.disk.mesh.F, a.filling),
                    surface_b = without_fillings(b.disk.mesh.F, b.filling);
    AlignedMaps aligned = align_features({a.disk.mesh, surface_a, a.disk.loop, a.disk.rays},
                                         {b.disk.mesh, surface_b, b.disk.loop, b.disk.rays}, options);
    a.disk.rays = std::move(aligned.rays_a);
    b.disk.rays = std::move(aligned.rays_b);
    FeatureReport& features = report.features.emplace_back();
    features.candidates_source = on_shape(a.disk, std::move(aligned.candidates_a));
    features.candidates_target = on_shape(b.disk, std::move(aligned.candidates_b));
    for (const FeatureMatch& match : aligned.matches) {
        features.matches.push_back(
            {on_shape(a.disk, match.vertex_a), on_shape(b.disk, match.vertex_b), match.difference});
    }
    features.in_place = aligned.in_place;
    features.warps = aligned.warps;
    features.rounds = aligned.rounds;
    features.distance_before = aligned.distance_before;
    features.distance_after = aligned.distance_after;
    if (features.in_place < static_cast<int>(features.matches.size())) {
        report.notes.push_back(
            fmt::format("{} of {} matched features{} lie on one another; more would fold a map",
                        features.in_place, features.matches.size(), label));
    }
}

}  // namespace automorph
