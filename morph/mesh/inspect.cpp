#include <algorithm>
#include <numeric>
#include <tuple>

#include "morph/mesh/admit.h"
#include "morph/mesh/edges.h"
#include "morph/mesh/mend.h"
#include "morph/mesh/triangulate.h"

namespace automorph {

MeshInspection inspect_triangles(const Points& V, const Triangles& F) {
    MeshInspection found;
    found.vertices = static_cast<int>(V.rows());
    found.polygons = found.triangles = static_cast<int>(F.rows());
    found.duplicate_vertices = static_cast<int>(V.rows()) - coincident_vertices(V).count;

    const EdgeTable edges = edge_table(F);
    const Labels components = edge_components(F, edges), corners = umbrellas(F, edges);
    found.components = components.count;
    found.boundary_loops = count_boundary_loops(edges, corners);
    for (int e = 0; e < edges.edge_count(); ++e) {
        const int uses = edges.use_count(e);
        found.boundary_edges += uses == 1 ? 1 : 0;
        found.non_manifold_edges += uses > 2 ? 1 : 0;
        found.inconsistent_edges += uses == 2 && edges.use(e, 0).forward == edges.use(e, 1).forward ? 1 : 0;
    }
    std::vector<int> umbrella(static_cast<std::size_t>(V.rows()), -1);
    std::vector<char> several(static_cast<std::size_t>(V.rows()), 0);
    for (Eigen::Index c = 0; c < F.size(); ++c) {
        const int v = F.data()[c];
        if (umbrella[v] < 0) umbrella[v] = corners.of[c];
        if (umbrella[v] != corners.of[c]) several[v] = 1;
    }
    found.unused_vertices = static_cast<int>(std::count(umbrella.begin(), umbrella.end(), -1));
    found.non_manifold_vertices = static_cast<int>(std::count(several.begin(), several.end(), 1));
    found.closed = F.rows() > 0 && found.boundary_edges == 0 && found.non_manifold_edges == 0;
    found.orientable = consistent_orientation(F, edges, components).conflicting_edge < 0;
    found.euler_characteristic =
        found.vertices - found.unused_vertices - edges.edge_count() + static_cast<int>(F.rows());
    const bool manifold = found.non_manifold_edges == 0 && found.non_manifold_vertices == 0;
    if (manifold && found.orientable) {
        found.genus = (2 * found.components - found.boundary_loops - found.euler_characteristic) / 2;
    } else {
        found.genus = -1;
    }
    return found;
}

MeshInspection inspect(const PolygonSoup& soup) {
    const TriangulatedSoup triangles = triangulate(soup);
    MeshInspection found = inspect_triangles(soup.V, triangles.F);
    found.polygons = soup.polygon_count();
    found.degenerate_triangles = triangles.degenerate;
    return found;
}

}  // namespace automorph
