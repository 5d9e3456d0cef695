#include "morph/merge_disks.h"

#include <fmt/format.h>

#include <algorithm>

#include "morph/mesh/geometry.h"
#include "morph/overlay/lift.h"
#include "morph/overlay/snap.h"
#include "morph/overlay/triangulate.h"
#include "morph/parameterization/disk_map.h"
#include "morph/parameterization/guided_map.h"

namespace automorph {

namespace {

/// Where the vertices of a bordered disk lie on its shape: inserted ones by the ratio along their border
/// edge.
std::vector<Site> sites_on_shape(const Disk& disk, const BorderedMesh& bordered) {
    std::vector<Site> sites = disk.sites;
    sites.reserve(sites.size() + bordered.inserted.size());
    for (const auto& inserted : bordered.inserted) {
        const Site on_edge{{inserted.from, inserted.to, -1}, {1.0 - inserted.ratio, inserted.ratio, 0.0}, 2};
        sites.push_back(compose(on_edge, disk.sites));
    }
    return sites;
}

std::vector<Site> composed(const std::vector<Site>& merged, const std::vector<Site>& on_shape) {
    std::vector<Site> result;
    result.reserve(merged.size());
    for (const Site& site : merged) result.push_back(compose(site, on_shape));
    return result;
}

/// Per triangle of a disk: one of its corners is the centre of a filling.
std::vector<char> filling_triangles(const Shape& shape, const Mesh& mesh, const std::vector<Site>& sites) {
    std::vector<char> filling(static_cast<std::size_t>(mesh.triangle_count()), 0);
    if (shape.own_vertices == shape.mesh.vertex_count()) return filling;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Site& corner = sites[static_cast<std::size_t>(mesh.F(f, k))];
            if (corner.count == 1 && corner.corners[0] >= shape.own_vertices)
                filling[static_cast<std::size_t>(f)] = 1;
        }
    }
    return filling;
}

MapReport map_report(const std::string& of, const DiskMap& map) {
    return {of,
            name(map.weights),
            map.reason,
            map.quality.flipped,
            map.quality.p01,
            map.quality.smallest_ratio,
            map.residual};
}

/// The map of a that follows the guide on b's map; a map of its own where it cannot be made one-to-one.
DiskMap aligned_map(const BorderedMesh& a, const Guide& guide, const BorderedMesh& b, const Points& rays_b,
                    const std::vector<char>& filling_b, const Points& circle, Report& report) {
    Mesh surface = b.mesh;
    int own = 0;
    for (int f = 0; f < b.mesh.triangle_count(); ++f) {
        if (!filling_b[static_cast<std::size_t>(f)]) surface.F.row(own++) = b.mesh.F.row(f);
    }
    surface.F.conservativeResize(own, 3);

    Points places(a.mesh.vertex_count(), 3);
    places.topRows(guide.x.rows()) = guided_rays(guide, surface, rays_b);
    std::vector<char> fixed(static_cast<std::size_t>(a.mesh.vertex_count()), 0);
    for (std::size_t k = 0; k < a.loop.size(); ++k) {
        places.row(a.loop[k]) = circle.row(static_cast<Eigen::Index>(k));
        fixed[static_cast<std::size_t>(a.loop[k])] = 1;
    }
    GuidedMap guided = guided_map(a.mesh, fixed, places, MapDomain::Disk);
    report.alignment.flipped_before = guided.flipped_before;
    report.alignment.moved = guided.moved;
    report.alignment.rounds = guided.rounds;
    if (guided.flipped > 0) {
        report.notes.push_back(
            fmt::format("the alignment was given up: {} triangles of the source could not be "
                        "turned back",
                        guided.flipped));
        return disk_map(a.mesh, a.loop, circle);
    }
    report.alignment.used = true;
    DiskMap map;
    map.weights = MapWeights::MeanValue;
    map.quality = map_quality(a.mesh, guided.rays);
    map.rays = std::move(guided.rays);
    return map;
}

int zero_area_triangles(const Points& V, const Triangles& F) {
    const Eigen::VectorXd areas = triangle_areas({V, F});
    return static_cast<int>((areas.array() <= 0.0).count());
}

}  // namespace

Points place_on(const Shape& shape, const std::vector<Site>& sites, bool curved) {
    return curved ? lift(shape.mesh.V, shape.normals, sites) : place(shape.mesh.V, sites);
}

MergedDisks merge_disks(const Shape& shape_a, const Disk& a, const Shape& shape_b, const Disk& b,
                        const BorderUnion& border, const Guide* guide, bool curved, const std::string& label,
                        Report& report) {
    const BorderedMesh bordered_a = insert_border(a.mesh, a.loop, border.source);
    const BorderedMesh bordered_b = insert_border(b.mesh, b.loop, border.target);
    const std::vector<Site> sites_a = sites_on_shape(a, bordered_a), sites_b = sites_on_shape(b, bordered_b);

    const std::vector<char> filling_a = filling_triangles(shape_a, bordered_a.mesh, sites_a);
    const std::vector<char> filling_b = filling_triangles(shape_b, bordered_b.mesh, sites_b);

    DiskMap map_a, map_b;
    {
        const StageClock clock(report, "maps" + label);
        const Points circle = border_rays(border.angles);
        map_b = disk_map(bordered_b.mesh, bordered_b.loop, circle);
        map_a = guide ? aligned_map(bordered_a, *guide, bordered_b, map_b.rays, filling_b, circle, report)
                      : disk_map(bordered_a.mesh, bordered_a.loop, circle);
        report.maps.push_back(map_report("source" + label, map_a));
        if (guide && report.alignment.used) report.maps.back().weights = "aligned";
        report.maps.push_back(map_report("target" + label, map_b));
    }

    Overlay merged;
    int snapped = 0;
    {
        const StageClock clock(report, "overlay" + label);
        snapped = snap_vertices(bordered_b.mesh, bordered_b.loop, map_b.rays, map_a.rays);
        merged = overlay(bordered_a.mesh, map_a.rays, bordered_b.mesh, map_b.rays);
    }

    const StageClock clock(report, "triangulation" + label);
    MergedDisks result;
    result.on_a = composed(merged.on_a, sites_a);
    result.on_b = composed(merged.on_b, sites_b);
    const Points points_a = place_on(shape_a, result.on_a, curved),
                 points_b = place_on(shape_b, result.on_b, curved);
    MergedTriangles triangles = triangulate(merged, bordered_a.mesh, points_a, bordered_b.mesh, points_b);
    result.F = std::move(triangles.F);
    for (const int vertex : bordered_a.loop)
        result.border.push_back(merged.vertex_of_a[static_cast<std::size_t>(vertex)]);

    for (const int face : triangles.face) {
        const auto fa = static_cast<std::size_t>(merged.face_of_a[static_cast<std::size_t>(face)]);
        const auto fb = static_cast<std::size_t>(merged.face_of_b[static_cast<std::size_t>(face)]);
        result.in_filling.push_back(filling_a[fa] || filling_b[fb]);
    }
    report.overlays.push_back({.vertices_a = bordered_a.mesh.vertex_count(),
                               .vertices_b = bordered_b.mesh.vertex_count(),
                               .crossings = merged.crossings,
                               .coincident = merged.coincident,
                               .snapped = snapped,
                               .on_edges = merged.on_edges,
                               .vertices = merged.vertex_count(),
                               .triangles = static_cast<int>(result.F.rows()),
                               .zero_area_a = zero_area_triangles(points_a, result.F),
                               .zero_area_b = zero_area_triangles(points_b, result.F)});
    return result;
}

}  // namespace automorph
