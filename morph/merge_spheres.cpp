#include "morph/merge_spheres.h"

#include <fmt/format.h>
#include <tbb/parallel_invoke.h>

#include "morph/follow_guide.h"
#include "morph/overlay/lift.h"
#include "morph/parameterization/sphere_border.h"
#include "morph/parameterization/sphere_map.h"
#include "morph/sphere_alignment/align_spheres.h"
#include "morph/sphere_alignment/movable_map.h"
#include "morph/stage_clock.h"

namespace automorph {

namespace {

/// Share of the source's vertices above which those that cannot follow a dense alignment are worth a note.
constexpr double kManyLate = 0.2;

MappedPart whole(const Shape& shape) {
    MappedPart part{shape.mesh, {}, {}, {}, {}};
    for (int v = 0; v < shape.mesh.vertex_count(); ++v)
        part.sites.push_back({{v, -1, -1}, {1.0, 0.0, 0.0}, 1});
    part.filling = filling_triangles(shape, part.mesh, part.sites);
    return part;
}

MappedPart without_chords(const Shape& shape, const MappedPart& part) {
    ChordFreeMesh split = split_chords(part.mesh, part.loop);
    MappedPart result{std::move(split.mesh), part.loop, part.sites, {}, {}};
    for (const auto& [u, v] : split.midpoint)
        result.sites.push_back(compose({{u, v, -1}, {0.5, 0.5, 0.0}, 2}, part.sites));
    result.filling = filling_triangles(shape, result.mesh, result.sites);
    return result;
}

/// A map of the part's own.
/// @param circle  rays of the border, none for a closed mesh
Points own_map(const MappedPart& part, const Points& circle) {
    return part.loop.empty() ? sphere_map(part.mesh).rays : sphere_map(part.mesh, part.loop, circle).rays;
}

void align(MappedPart& a, MappedPart& b, const SphereOptions& options, Report& report) {
    const StageClock clock(report, "alignment on the sphere");
    AlignedSpheres aligned =
        align_spheres({a.mesh, a.loop, a.rays, a.filling}, {b.mesh, b.loop, b.rays, b.filling},
                      *options.registration, options.seed);
    a.rays = std::move(aligned.rays_a);
    b.rays = std::move(aligned.rays_b);
    report.sphere_alignment = {aligned.matches, aligned.before, aligned.rotated, aligned.after};
}

/// Lays a's vertices where the guide puts them on b, as far as a's map stays one-to-one.
void follow(MappedPart& a, const MappedPart& b, const Guide& guide, Report& report) {
    const StageClock clock(report, "dense map");
    const Points places = guided_places(a, guide, b, MapDomain::Sphere);
    MovableMap map(a.mesh, a.loop, a.rays);
    const int late = map.follow(places);
    a.rays = map.rays();
    report.alignment.used = true;
    report.alignment.flipped_before = flipped_triangles(a.mesh.F, places);
    report.alignment.moved = late;
    report.alignment.rounds = 0;  // those of an attempt on the disk
    if (late > kManyLate * a.mesh.vertex_count()) {
        report.notes.push_back(fmt::format(
            "{} of {} vertices of the source follow the dense alignment only as far as the map stays "
            "one-to-one: the shapes, or their registration, differ much",
            late, a.mesh.vertex_count()));
    }
}

/// Maps both parts onto the sphere and brings the maps together.
void map_parts(MappedPart& a, MappedPart& b, const Points& circle, const SphereOptions& options,
               Report& report) {
    {
        const StageClock clock(report, "maps on the sphere");
        tbb::parallel_invoke([&] { a.rays = own_map(a, circle); }, [&] { b.rays = own_map(b, circle); });
    }
    if (options.registration != nullptr) align(a, b, options, report);
    if (options.guide != nullptr) follow(a, b, *options.guide, report);
    for (const MappedPart* part : {&a, &b}) {
        const MapQuality quality = sphere_map_quality(part->mesh, part->rays);
        MapReport map;
        map.of = part == &a ? "source" : "target";
        map.weights = part == &a && options.guide != nullptr ? "aligned" : "progressive";
        map.flipped = quality.flipped;
        map.p01 = quality.p01;
        map.smallest_ratio = quality.smallest_ratio;
        report.maps.push_back(map);
    }
}

}  // namespace

MergedPair merge_spheres(const Shape& shape_a, const Shape& shape_b, const SphereOptions& options,
                         Report& report) {
    MappedPart a = whole(shape_a), b = whole(shape_b);
    map_parts(a, b, Points(0, 3), options, report);
    return merge_maps(shape_a, a, shape_b, std::move(b), options.curved, "", report);
}

MergedPair merge_locked_spheres(const Shape& shape_a, const Shape& shape_b, const BorderedDisks& disks,
                                const SphereOptions& options, Report& report) {
    MappedPart a = without_chords(shape_a, disks.a), b = without_chords(shape_b, disks.b);
    const double z = locked_height(cap_share(a.mesh, a.loop), cap_share(b.mesh, b.loop));
    map_parts(a, b, locked_border(disks.angles, z), options, report);
    return merge_maps(shape_a, a, shape_b, std::move(b), options.curved, "", report);
}

}  // namespace automorph
