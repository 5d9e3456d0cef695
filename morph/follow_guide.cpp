#include "morph/follow_guide.h"

#include "morph/overlay/lift.h"

namespace automorph {

namespace {

/// The guide for a part of the source, whose vertices may be more than the shape's: borders inserted, chords
/// split.
Guide guide_of(const MappedPart& part, const Guide& guide) {
    Guide result = guide;
    result.x = place(guide.x, part.sites);
    result.normals = place(guide.normals, part.sites).rowwise().normalized();
    return result;
}

}  // namespace

Points guided_places(const MappedPart& a, const Guide& guide, const MappedPart& b, MapDomain domain) {
    Mesh surface = b.mesh;
    int own = 0;
    for (int f = 0; f < b.mesh.triangle_count(); ++f) {
        if (!b.filling[static_cast<std::size_t>(f)]) surface.F.row(own++) = b.mesh.F.row(f);
    }
    surface.F.conservativeResize(own, 3);
    Points places = guided_rays(guide_of(a, guide), surface, b.rays);
    if (domain == MapDomain::Sphere) places.rowwise().normalize();
    for (const int v : a.loop) places.row(v) = a.rays.row(v);
    return places;
}

std::optional<Points> follow_guide(const MappedPart& a, const Guide& guide, const MappedPart& b,
                                   Report& report) {
    std::vector<char> fixed(static_cast<std::size_t>(a.mesh.vertex_count()), 0);
    for (const int v : a.loop) fixed[static_cast<std::size_t>(v)] = 1;
    GuidedMap guided =
        guided_map(a.mesh, fixed, guided_places(a, guide, b, MapDomain::Disk), MapDomain::Disk);
    report.alignment.flipped_before = guided.flipped_before;
    report.alignment.moved = guided.moved;
    report.alignment.rounds = guided.rounds;
    if (guided.flipped > 0) return std::nullopt;
    report.alignment.used = true;
    return std::move(guided.rays);
}

}  // namespace automorph
