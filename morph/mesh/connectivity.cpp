#include "morph/mesh/connectivity.h"

#include <fmt/format.h>

#include <algorithm>

#include "morph/mesh/errors.h"

namespace automorph {

Connectivity connectivity(const Triangles& F, int vertex_count) {
    Connectivity topology;
    const auto faces = static_cast<std::size_t>(F.rows());
    topology.reserve(static_cast<std::size_t>(vertex_count), 3 * faces / 2 + 16, faces);
    for (int v = 0; v < vertex_count; ++v) topology.new_vertex();
    for (int f = 0; f < F.rows(); ++f) {
        const auto added = topology.add_face(OpenMesh::VertexHandle(F(f, 0)), OpenMesh::VertexHandle(F(f, 1)),
                                             OpenMesh::VertexHandle(F(f, 2)));
        if (!added.is_valid()) {
            throw InvalidMesh(
                fmt::format("triangle {} ({} {} {}) does not fit its neighbours: the mesh is not a "
                            "consistently oriented manifold",
                            f, F(f, 0), F(f, 1), F(f, 2)));
        }
    }
    return topology;
}

std::vector<std::vector<int>> boundary_loops(const Mesh& mesh, const Connectivity& topology) {
    struct Loop {
        double length = 0.0;
        std::vector<int> vertices;
    };
    std::vector<Loop> found;
    std::vector<bool> seen(topology.n_halfedges(), false);
    for (const auto first : topology.halfedges()) {
        if (!first.is_boundary() || seen[static_cast<std::size_t>(first.idx())]) continue;
        Loop loop;
        // A boundary half-edge has the surface on its right: walk backwards.
        OpenMesh::HalfedgeHandle h = first;
        do {
            const int from = topology.from_vertex_handle(h).idx(), to = topology.to_vertex_handle(h).idx();
            seen[static_cast<std::size_t>(h.idx())] = true;
            loop.vertices.push_back(to);
            loop.length += (mesh.V.row(to) - mesh.V.row(from)).norm();
            h = topology.prev_halfedge_handle(h);
        } while (h != first);
        std::rotate(loop.vertices.begin(), std::min_element(loop.vertices.begin(), loop.vertices.end()),
                    loop.vertices.end());
        found.push_back(std::move(loop));
    }
    std::sort(found.begin(), found.end(), [](const Loop& x, const Loop& y) {
        return x.length != y.length ? x.length > y.length : x.vertices < y.vertices;
    });
    std::vector<std::vector<int>> loops;
    for (Loop& loop : found) loops.push_back(std::move(loop.vertices));
    return loops;
}

int euler_characteristic(const Connectivity& topology) {
    return static_cast<int>(topology.n_vertices()) - static_cast<int>(topology.n_edges()) +
           static_cast<int>(topology.n_faces());
}

std::vector<std::vector<int>> boundary_loops(const Mesh& mesh) {
    return boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count()));
}

}  // namespace automorph
