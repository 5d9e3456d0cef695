#include "morph/merge_disks.h"

#include <algorithm>

#include "morph/align_disks.h"
#include "morph/mesh/geometry.h"
#include "morph/overlay/lift.h"
#include "morph/overlay/snap.h"
#include "morph/overlay/triangulate.h"
#include "morph/parameterization/disk_map.h"

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

int zero_area_triangles(const Points& V, const Triangles& F) {
    const Eigen::VectorXd areas = triangle_areas({V, F});
    return static_cast<int>((areas.array() <= 0.0).count());
}

}  // namespace

Points place_on(const Shape& shape, const std::vector<Site>& sites, bool curved) {
    return curved ? lift(shape.mesh.V, shape.normals, sites) : place(shape.mesh.V, sites);
}

MergedDisks merge_disks(const Shape& shape_a, const Disk& a, const Shape& shape_b, const Disk& b,
                        const BorderUnion& border, const MergeOptions& options, const std::string& label,
                        Report& report) {
    const BorderedMesh bordered_a = insert_border(a.mesh, a.loop, border.source);
    const BorderedMesh bordered_b = insert_border(b.mesh, b.loop, border.target);
    const std::vector<Site> sites_a = sites_on_shape(a, bordered_a), sites_b = sites_on_shape(b, bordered_b);

    DiskMap map_a, map_b;
    {
        const StageClock clock(report, "maps" + label);
        const Points circle = border_rays(border.angles);
        map_a = disk_map(bordered_a.mesh, bordered_a.loop, circle);
        map_b = disk_map(bordered_b.mesh, bordered_b.loop, circle);
        report.maps.push_back(map_report("source" + label, map_a));
        report.maps.push_back(map_report("target" + label, map_b));
    }

    const std::vector<char> filling_a = filling_triangles(shape_a, bordered_a.mesh, sites_a);
    const std::vector<char> filling_b = filling_triangles(shape_b, bordered_b.mesh, sites_b);
    if (options.align_features) {
        align_disks({bordered_a.mesh, bordered_a.loop, filling_a, map_a.rays},
                    {bordered_b.mesh, bordered_b.loop, filling_b, map_b.rays}, label, report);
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
    const Points points_a = place_on(shape_a, result.on_a, options.curved),
                 points_b = place_on(shape_b, result.on_b, options.curved);
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
