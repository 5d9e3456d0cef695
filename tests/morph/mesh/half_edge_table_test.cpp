#include "morph/mesh/half_edge_table.h"

#include <set>
#include <utility>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

/// Closed, with a border, with two, and a single triangle.
std::vector<Mesh> some_meshes() {
    Mesh triangle = grid(1);
    triangle.F.conservativeResize(1, 3);
    return {sphere(2), grid(5), grid(5, [](int i, int j) { return i == 2 && j == 2; }), triangle};
}

}  // namespace

TEST_CASE("opposites, borders and turns are those of the half-edge mesh") {
    for (const Mesh& mesh : some_meshes()) {
        const HalfEdgeTable half_edges(mesh.F, mesh.vertex_count());
        const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
        REQUIRE(half_edges.count() == 3 * mesh.triangle_count());
        for (int h = 0; h < half_edges.count(); ++h) {
            const auto same = topology.find_halfedge(OpenMesh::VertexHandle(half_edges.from(h)),
                                                     OpenMesh::VertexHandle(half_edges.to(h)));
            REQUIRE(same.is_valid());
            CHECK(topology.face_handle(same).idx() == HalfEdgeTable::face(h));
            CHECK(topology.face_handle(topology.opposite_halfedge_handle(same)).idx() ==
                  half_edges.face_across(h));
            CHECK(topology.to_vertex_handle(topology.next_halfedge_handle(same)).idx() == half_edges.apex(h));
            const int opposite = half_edges.opposite(h);
            if (opposite < 0) continue;
            CHECK(half_edges.opposite(opposite) == h);
            CHECK(half_edges.from(opposite) == half_edges.to(h));
            CHECK(half_edges.edge(opposite) == half_edges.edge(h));
        }
        for (int v = 0; v < half_edges.vertex_count(); ++v) {
            int triangles = 0;
            for (int h = half_edges.outgoing(v); h >= 0; ++triangles) {
                REQUIRE(half_edges.from(h) == v);
                h = half_edges.turn(h);
                if (h == half_edges.outgoing(v)) h = -1;
            }
            const auto handle = OpenMesh::VertexHandle(v);
            // The lone corner that `triangle` drops is in no triangle.
            const int expected = topology.is_isolated(handle) ? 0
                                                              : static_cast<int>(topology.valence(handle)) -
                                                                    topology.is_boundary(handle);
            CHECK(triangles == expected);
        }
    }
}

TEST_CASE("spreading meets every edge once, from a vertex met before") {
    for (const Mesh& mesh : some_meshes()) {
        const HalfEdgeTable half_edges(mesh.F, mesh.vertex_count());
        for (const int seed : {mesh.F(0, 0), mesh.F(mesh.triangle_count() - 1, 2)}) {
            std::set<int> met{seed};
            std::set<std::pair<int, int>> edges;
            spread(half_edges, seed, [&](int h) {
                CHECK(met.count(half_edges.from(h)) == 1);
                met.insert(half_edges.to(h));
                CHECK(edges.insert(std::minmax(half_edges.from(h), half_edges.to(h))).second);
            });
            CHECK(edges.size() == connectivity(mesh.F, mesh.vertex_count()).n_edges());
        }
    }
}

TEST_CASE("an edge with three triangles is refused") {
    Triangles F(3, 3);
    F << 0, 1, 2, 1, 0, 3, 0, 1, 4;
    CHECK_THROWS_AS(HalfEdgeTable(F, 5), InvalidMesh);
    F.row(2) << 1, 0, 4;
    CHECK_THROWS_AS(HalfEdgeTable(F, 5), InvalidMesh);
}
