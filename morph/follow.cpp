#include "morph/follow.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "morph/alignment/places.h"
#include "morph/overlay/lift.h"
#include "morph/parameterization/map_quality.h"
#include "morph/stage_clock.h"

namespace automorph {

namespace {

/// The part without the triangles of fillings.
Mesh surface_of(const Shape& shape, const MappedPart& part) {
    const std::vector<char> filling = filling_triangles(shape, part);
    Mesh surface = part.mesh;
    Eigen::Index own = 0;
    for (Eigen::Index f = 0; f < part.mesh.F.rows(); ++f) {
        if (!filling[static_cast<std::size_t>(f)]) surface.F.row(own++) = part.mesh.F.row(f);
    }
    surface.F.conservativeResize(own, 3);
    return surface;
}

bool covers_as_before(const Mesh& mesh, const Points& before, const Points& after) {
    return std::abs(total_solid_angle(mesh.F, before) - total_solid_angle(mesh.F, after)) < std::numbers::pi;
}

}  // namespace

bool follow(const Guide& guide, MappedPart& a, const Shape& shape_b, const MappedPart& b, MapDomain domain,
            Report& report) {
    const StageClock clock(report, "guided map");
    // Vertices of the part, refined ones included, at their places on the moved source.
    const Points x = place(guide.x, a.sites), normals = place(guide.normals, a.sites);
    const std::vector<SurfacePlace> on_b = places_on(surface_of(shape_b, b), x, normals);
    Points places(x.rows(), 3);
    for (Eigen::Index v = 0; v < x.rows(); ++v) places.row(v) = on_b[static_cast<std::size_t>(v)].in(b.rays);
    // Vertices of shapes come first in their parts and keep their numbers.
    for (const auto& [vertex, place] : guide.pinned) places.row(vertex) = place.in(b.rays);
    if (domain == MapDomain::Sphere) places.rowwise().normalize();
    std::vector<char> fixed(a.sites.size(), 0);
    for (const int v : a.loop) {
        places.row(v) = a.rays.row(v);
        fixed[static_cast<std::size_t>(v)] = 1;
    }

    GuidedMap map = guided_map(a.mesh, fixed, places, domain);
    report.alignment.flipped_before = map.flipped_before;
    report.alignment.moved = map.moved;
    report.alignment.rounds = map.rounds;
    if (map.flipped > 0 || !map.rays.allFinite() || !covers_as_before(a.mesh, a.rays, map.rays)) {
        report.notes.push_back(fmt::format(
            "the dense alignment was given up: {} triangles of the source could not be turned back",
            map.flipped));
        return false;
    }
    a.rays = std::move(map.rays);
    report.alignment.used = true;
    return true;
}

}  // namespace automorph
