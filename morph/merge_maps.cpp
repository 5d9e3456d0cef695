#include "morph/merge_maps.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "morph/mesh/geometry.h"
#include "morph/mesh/half_edge_table.h"
#include "morph/overlay/lift.h"
#include "morph/overlay/snap.h"
#include "morph/overlay/triangulate.h"
#include "morph/stage_clock.h"

namespace automorph {

namespace {

std::vector<Site> composed(const std::vector<Site>& merged, const std::vector<Site>& on_shape) {
    std::vector<Site> result;
    result.reserve(merged.size());
    for (const Site& site : merged) result.push_back(compose(site, on_shape));
    return result;
}

/// Tells merged triangles that face against the triangle they lie in.
class Facing {
public:
    /// @param parent  per merged triangle: the part's triangle
    Facing(const Triangles& F, const Mesh& part, const std::vector<int>& parent)
        : F_(F), part_(part), parent_(parent), flat_(kFlatHeight * bounding_box_diagonal(part.V)) {}

    /// @param points  #merged x 3 places of merged vertices on the part's shape
    bool turned(const Points& points, int f) const {
        const Eigen::Vector3d facing =
            doubled_area_vector(part_.V, part_.F, parent_[static_cast<std::size_t>(f)]).stableNormalized();
        return doubled_area_vector(points, F_, f).dot(facing) < -flat_ * longest_edge(points, F_, f);
    }

private:
    const Triangles& F_;
    const Mesh& part_;
    const std::vector<int>& parent_;
    double flat_;
};

int zero_area_triangles(const Points& V, const Triangles& F) {
    const Eigen::VectorXd areas = triangle_areas({V, F});
    return static_cast<int>((areas.array() <= 0.0).count());
}

Points place_on(const Shape& shape, const std::vector<Site>& sites, bool curved) {
    return curved ? lift(shape.mesh.V, shape.normals, sites) : place(shape.mesh.V, sites);
}

struct Flattened {
    int vertices = 0;  ///< put back on their facets
    int turned = 0;    ///< triangles that are turned still
};

/// Puts the corners of turned triangles back on their facets, until none is turned or there is nothing left
/// to put back. That can turn neighbours, ring by ring; after the first look only what moved is looked at.
Flattened flatten_turned(const Triangles& F, const Points& flat, const Mesh& part,
                         const std::vector<int>& parent, Points& points) {
    const Facing facing(F, part, parent);
    std::vector<char> is_turned(static_cast<std::size_t>(F.rows()), 0);
    std::vector<int> turned;
    for (int f = 0; f < F.rows(); ++f) {
        if (!facing.turned(points, f)) continue;
        is_turned[static_cast<std::size_t>(f)] = 1;
        turned.push_back(f);
    }
    if (turned.empty()) return {};

    Flattened result;
    const HalfEdgeTable edges(F, static_cast<int>(points.rows()));
    while (!turned.empty()) {
        std::vector<int> moved;
        for (const int f : turned) {
            for (int k = 0; k < 3; ++k) {
                const int v = F(f, k);
                if (points.row(v) == flat.row(v)) continue;
                points.row(v) = flat.row(v);
                moved.push_back(v);
            }
        }
        result.vertices += static_cast<int>(moved.size());
        turned.clear();
        for (const int v : moved) {
            const int first = edges.outgoing(v);
            int h = first;
            do {
                const int f = HalfEdgeTable::face(h);
                is_turned[static_cast<std::size_t>(f)] = facing.turned(points, f);
                if (is_turned[static_cast<std::size_t>(f)]) turned.push_back(f);
                h = edges.turn(h);
            } while (h >= 0 && h != first);
        }
    }
    result.turned = static_cast<int>(std::count(is_turned.begin(), is_turned.end(), 1));
    return result;
}

}  // namespace

std::vector<char> filling_triangles(const Shape& shape, const MappedPart& part) {
    std::vector<char> filling(static_cast<std::size_t>(part.mesh.triangle_count()), 0);
    if (shape.own_vertices == shape.mesh.vertex_count()) return filling;
    for (int f = 0; f < part.mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const Site& corner = part.sites[static_cast<std::size_t>(part.mesh.F(f, k))];
            if (corner.count == 1 && corner.corners[0] >= shape.own_vertices)
                filling[static_cast<std::size_t>(f)] = 1;
        }
    }
    return filling;
}

Triangles without_fillings(const Triangles& F, const std::vector<char>& filling) {
    Triangles surface(F.rows(), 3);
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < F.rows(); ++f) {
        if (!filling[static_cast<std::size_t>(f)]) surface.row(kept++) = F.row(f);
    }
    surface.conservativeResize(kept, 3);
    return surface;
}

MergedPair merge_maps(const Shape& shape_a, const MappedPart& a, const Shape& shape_b, MappedPart b,
                      bool curved, const std::string& label, Report& report) {
    Overlay merged;
    int snapped = 0;
    {
        const StageClock clock(report, "overlay" + label);
        snapped = snap_vertices(b.mesh, b.loop, b.rays, a.rays);
        merged = overlay(a.mesh, a.rays, b.mesh, b.rays);
    }

    const StageClock clock(report, "triangulation" + label);
    MergedPair result;
    result.on_a = composed(merged.on_a, a.sites);
    result.on_b = composed(merged.on_b, b.sites);
    result.points_a = place_on(shape_a, result.on_a, curved);
    result.points_b = place_on(shape_b, result.on_b, curved);
    MergedTriangles triangles = triangulate(merged, a.mesh, result.points_a, b.mesh, result.points_b);
    result.F = std::move(triangles.F);
    for (const int vertex : a.loop)
        result.border.push_back(merged.vertex_of_a[static_cast<std::size_t>(vertex)]);

    const std::vector<char> filling_a = filling_triangles(shape_a, a),
                            filling_b = filling_triangles(shape_b, b);
    std::vector<int> parent_a, parent_b;  // per merged triangle: those that contain it
    for (const int face : triangles.face) {
        parent_a.push_back(merged.face_of_a[static_cast<std::size_t>(face)]);
        parent_b.push_back(merged.face_of_b[static_cast<std::size_t>(face)]);
        result.in_filling.push_back(filling_a[static_cast<std::size_t>(parent_a.back())] ||
                                    filling_b[static_cast<std::size_t>(parent_b.back())]);
    }
    const Flattened on_a =
        flatten_turned(result.F, place(shape_a.mesh.V, result.on_a), a.mesh, parent_a, result.points_a);
    const Flattened on_b =
        flatten_turned(result.F, place(shape_b.mesh.V, result.on_b), b.mesh, parent_b, result.points_b);
    report.overlays.push_back({.vertices_a = a.mesh.vertex_count(),
                               .vertices_b = b.mesh.vertex_count(),
                               .crossings = merged.crossings,
                               .coincident = merged.coincident,
                               .snapped = snapped,
                               .on_edges = merged.on_edges,
                               .vertices = merged.vertex_count(),
                               .triangles = static_cast<int>(result.F.rows()),
                               .zero_area_a = zero_area_triangles(result.points_a, result.F),
                               .zero_area_b = zero_area_triangles(result.points_b, result.F),
                               .turned_a = on_a.turned,
                               .turned_b = on_b.turned,
                               .flattened_a = on_a.vertices,
                               .flattened_b = on_b.vertices});
    result.maps.push_back({{a.mesh, filling_a, a.loop, a.rays},
                           {std::move(b.mesh), filling_b, std::move(b.loop), std::move(b.rays)},
                           label.empty() ? label : label.substr(1)});
    return result;
}

}  // namespace automorph
