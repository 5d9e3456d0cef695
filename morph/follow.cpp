#include "morph/follow.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "morph/alignment/places.h"
#include "morph/mesh/geometry.h"
#include "morph/overlay/lift.h"
#include "morph/parameterization/guided_map.h"
#include "morph/parameterization/map_quality.h"
#include "morph/sphere_alignment/movable_map.h"
#include "morph/stage_clock.h"

namespace automorph {

namespace {

/// Share of the source's vertices above which those that cannot follow on the sphere are worth a note.
constexpr double kManyLate = 0.2;

/// Distance from its place, in diagonals of the other shape's box, at which a vertex counts for exp(-1/2).
constexpr double kTrustedGap = 0.02;

/// Places on b's surface of a's vertices, refined ones included, moved as the guide says.
std::vector<SurfacePlace> surface_places(const Guide& guide, const MappedPart& a, const Shape& shape_b,
                                         const MappedPart& b) {
    const Mesh surface_b{b.mesh.V, without_fillings(b.mesh.F, filling_triangles(shape_b, b))};
    return places_on(surface_b, place(guide.x, a.sites), place(guide.normals, a.sites));
}

/// Where a's vertices belong in b's map; the loop's vertices are where they are.
Points places_in(const Guide& guide, const MappedPart& a, const Shape& shape_b, const MappedPart& b) {
    const std::vector<SurfacePlace> on_b = surface_places(guide, a, shape_b, b);
    Points places(a.rays.rows(), 3);
    for (Eigen::Index v = 0; v < places.rows(); ++v)
        places.row(v) = on_b[static_cast<std::size_t>(v)].in(b.rays);
    // Vertices of shapes come first in their parts and keep their numbers.
    for (const auto& [vertex, place] : guide.pinned) places.row(vertex) = place.in(b.rays);
    for (const int v : a.loop) places.row(v) = a.rays.row(v);
    return places;
}

/// Centres of fillings without a known place go to the middle of where their rims go, on the filling's side:
/// the filling of a border may well be the larger part of the sphere.
void centre_fillings(const Guide& guide, const Shape& shape, const MappedPart& part, Points& places) {
    Points middle = Points::Zero(shape.mesh.vertex_count() - shape.own_vertices, 3);
    for (int f = 0; f < part.mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int c = part.mesh.F(f, k);
            if (c < shape.own_vertices || c >= shape.mesh.vertex_count()) continue;
            const Eigen::Vector3d u = places.row(part.mesh.F(f, (k + 1) % 3)),
                                  w = places.row(part.mesh.F(f, (k + 2) % 3));
            middle.row(c - shape.own_vertices) += u.cross(w).transpose();
        }
    }
    for (const auto& [vertex, place] : guide.pinned) {
        if (vertex >= shape.own_vertices) middle.row(vertex - shape.own_vertices).setZero();
    }
    for (Eigen::Index k = 0; k < middle.rows(); ++k) {
        if (!middle.row(k).isZero(0.0)) places.row(shape.own_vertices + k) = middle.row(k).stableNormalized();
    }
}

}  // namespace

bool follow_on_disk(const Guide& guide, MappedPart& a, const Shape& shape_b, const MappedPart& b,
                    Report& report) {
    const StageClock clock(report, "guided map");
    std::vector<char> fixed(a.sites.size(), 0);
    for (const int v : a.loop) fixed[static_cast<std::size_t>(v)] = 1;
    GuidedMap map = guided_map(a.mesh, fixed, places_in(guide, a, shape_b, b), MapDomain::Disk);
    report.alignment.flipped_before = map.flipped_before;
    report.alignment.moved = map.moved;
    report.alignment.rounds = map.rounds;
    if (map.flipped > 0 || !map.rays.allFinite()) {
        report.notes.push_back(fmt::format(
            "the dense alignment was given up: {} triangles of the source could not be turned back",
            map.flipped));
        return false;
    }
    a.rays = std::move(map.rays);
    report.alignment.used = true;
    return true;
}

SurfaceMatches guided_matches(const Guide& guide, const Shape& shape_a, const MappedPart& a,
                              const Shape& shape_b, const MappedPart& b) {
    const std::vector<SurfacePlace> on_b = surface_places(guide, a, shape_b, b);
    const Points x = place(guide.x, a.sites);
    const Eigen::VectorXd areas =
        vertex_areas({a.mesh.V, without_fillings(a.mesh.F, filling_triangles(shape_a, a))});
    const double trusted = kTrustedGap * bounding_box_diagonal(shape_b.mesh.V);
    SurfaceMatches matches;
    std::vector<double> weights;
    for (int v = 0; v < a.mesh.vertex_count(); ++v) {
        if (!(areas[v] > 0.0)) continue;
        const SurfacePlace& there = on_b[static_cast<std::size_t>(v)];
        const double gap = (there.in(b.mesh.V) - x.row(v)).norm() / trusted;
        matches.on_a.push_back({{v, v, v}, {1.0, 0.0, 0.0}});
        matches.on_b.push_back({there.corners, {there.weights[0], there.weights[1], there.weights[2]}});
        weights.push_back(areas[v] * std::exp(-0.5 * gap * gap));
    }
    matches.weights = Eigen::Map<Eigen::VectorXd>(weights.data(), static_cast<Eigen::Index>(weights.size()));
    return matches;
}

void follow_on_sphere(const Guide& guide, const Shape& shape_a, MappedPart& a, const Shape& shape_b,
                      const MappedPart& b, Report& report) {
    const StageClock clock(report, "guided map");
    Points places = places_in(guide, a, shape_b, b).rowwise().normalized();
    centre_fillings(guide, shape_a, a, places);
    report.alignment.flipped_before = flipped_triangles(a.mesh.F, places);
    MovableMap map(a.mesh, a.loop, a.rays);
    const int late = map.follow(places);
    a.rays = map.rays();
    report.alignment.moved = late;
    report.alignment.used = true;
    if (late > kManyLate * a.mesh.vertex_count()) {
        report.notes.push_back(fmt::format(
            "{} of {} vertices of the moved shape follow the dense alignment only as far as the map stays "
            "one-to-one: the shapes, or their registration, differ much",
            late, a.mesh.vertex_count()));
    }
}

}  // namespace automorph
