#include "morph/merge_spheres.h"

#include <tbb/parallel_invoke.h>

#include <utility>

#include "morph/follow.h"
#include "morph/overlay/lift.h"
#include "morph/parameterization/sphere_border.h"
#include "morph/parameterization/sphere_map.h"
#include "morph/report_of.h"
#include "morph/sphere_alignment/align_spheres.h"
#include "morph/stage_clock.h"

namespace automorph {

namespace {

MappedPart whole(const Shape& shape) {
    MappedPart part{shape.mesh, {}, {}, {}};
    for (int v = 0; v < shape.mesh.vertex_count(); ++v)
        part.sites.push_back({{v, -1, -1}, {1.0, 0.0, 0.0}, 1});
    return part;
}

MappedPart without_chords(const MappedPart& part) {
    ChordFreeMesh split = split_chords(part.mesh, part.loop);
    MappedPart result{std::move(split.mesh), part.loop, part.sites, {}};
    for (const auto& [u, v] : split.midpoint)
        result.sites.push_back(compose({{u, v, -1}, {0.5, 0.5, 0.0}, 2}, part.sites));
    return result;
}

/// What is to meet on the sphere: near points of the registered shapes; where limbs were laid on one another
/// the points that belong together after that, since an arm that hangs is near the hip of one that is raised.
SurfaceMatches sphere_matches(const Shape& shape_a, const MappedPart& a, const Shape& shape_b,
                              const MappedPart& b, const SphereOptions& options) {
    if (!options.guide || options.guide->matched_tips.empty()) {
        return match_surfaces({a.mesh, filling_triangles(shape_a, a)},
                              {b.mesh, filling_triangles(shape_b, b)}, *options.registration, options.seed);
    }
    if (!options.moves_b) return guided_matches(*options.guide, shape_a, a, shape_b, b);
    SurfaceMatches matches = guided_matches(*options.guide, shape_b, b, shape_a, a);
    std::swap(matches.on_a, matches.on_b);
    return matches;
}

MergedPair merge(const Shape& shape_a, MappedPart a, const Shape& shape_b, MappedPart b,
                 const SphereOptions& options, Report& report) {
    if (options.registration) {
        const StageClock clock(report, "alignment on the sphere");
        AlignedSpheres aligned = align_spheres({a.mesh, a.loop, a.rays}, {b.mesh, b.loop, b.rays},
                                               sphere_matches(shape_a, a, shape_b, b, options));
        a.rays = std::move(aligned.rays_a);
        b.rays = std::move(aligned.rays_b);
        report.sphere_alignment = {aligned.matches, aligned.before, aligned.rotated, aligned.after};
    }
    if (options.guide && !options.moves_b) follow_on_sphere(*options.guide, shape_a, a, shape_b, b, report);
    if (options.guide && options.moves_b) follow_on_sphere(*options.guide, shape_b, b, shape_a, a, report);
    const MappedPart* moved = options.moves_b ? &b : &a;
    const char* name = a.loop.empty() ? "progressive embedding" : "progressive embedding, border locked";
    for (const MappedPart* part : {&a, &b}) {
        report.maps.push_back(report_of(part == &a ? "source" : "target",
                                        options.guide && part == moved ? "dense alignment" : name,
                                        sphere_map_quality(part->mesh, part->rays)));
    }
    return merge_maps(shape_a, a, shape_b, std::move(b), options.curved, "", report);
}

}  // namespace

MergedPair merge_spheres(const Shape& shape_a, const Shape& shape_b, const SphereOptions& options,
                         Report& report) {
    MappedPart a = whole(shape_a), b = whole(shape_b);
    {
        const StageClock clock(report, "maps");
        tbb::parallel_invoke([&] { a.rays = sphere_map(a.mesh).rays; },
                             [&] { b.rays = sphere_map(b.mesh).rays; });
    }
    return merge(shape_a, std::move(a), shape_b, std::move(b), options, report);
}

MergedPair merge_locked_spheres(const Shape& shape_a, const Shape& shape_b, const BorderedDisks& disks,
                                const SphereOptions& options, Report& report) {
    MappedPart a = without_chords(disks.a), b = without_chords(disks.b);
    {
        const StageClock clock(report, "maps on the sphere");
        const double z = locked_height(cap_share(a.mesh, a.loop), cap_share(b.mesh, b.loop));
        const Points circle = locked_border(disks.angles, z);
        tbb::parallel_invoke([&] { a.rays = sphere_map(a.mesh, a.loop, circle).rays; },
                             [&] { b.rays = sphere_map(b.mesh, b.loop, circle).rays; });
    }
    return merge(shape_a, std::move(a), shape_b, std::move(b), options, report);
}

}  // namespace automorph
