#include "morph/overlay/half_edges.h"

#include <set>
#include <utility>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "test_maps.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

std::vector<TestMap> some_maps() {
    Random random(1);
    return {
        renumbered(delaunay_map(polygon_builder(circle(9), random), random_disk_points(60, random)), random),
        renumbered(random_map(octahedron_builder(), random_directions(40, random), 30, random), random),
        polygon_builder(circle(3), random).map()};
}

}  // namespace

TEST_CASE("opposites, borders and turns are those of the half-edge mesh") {
    for (const TestMap& map : some_maps()) {
        const HalfEdges half_edges(map.mesh.F, map.mesh.vertex_count());
        const Connectivity topology = connectivity(map.mesh.F, map.mesh.vertex_count());
        REQUIRE(half_edges.count() == 3 * map.mesh.triangle_count());
        for (int h = 0; h < half_edges.count(); ++h) {
            const auto same = topology.find_halfedge(OpenMesh::VertexHandle(half_edges.from(h)),
                                                     OpenMesh::VertexHandle(half_edges.to(h)));
            REQUIRE(same.is_valid());
            CHECK(topology.face_handle(same).idx() == HalfEdges::face(h));
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
            CHECK(triangles == static_cast<int>(topology.valence(handle)) - topology.is_boundary(handle));
        }
    }
}

TEST_CASE("spreading meets every edge once, from a vertex met before") {
    for (const TestMap& map : some_maps()) {
        const HalfEdges half_edges(map.mesh.F, map.mesh.vertex_count());
        for (const int seed : {0, map.mesh.vertex_count() - 1}) {
            std::set<int> met{seed};
            std::set<std::pair<int, int>> edges;
            spread(half_edges, seed, [&](int h) {
                CHECK(met.count(half_edges.from(h)) == 1);
                met.insert(half_edges.to(h));
                CHECK(edges.insert(std::minmax(half_edges.from(h), half_edges.to(h))).second);
            });
            CHECK(edges.size() == connectivity(map.mesh.F, map.mesh.vertex_count()).n_edges());
        }
    }
}

TEST_CASE("an edge with three triangles is refused") {
    Triangles F(3, 3);
    F << 0, 1, 2, 1, 0, 3, 0, 1, 4;
    CHECK_THROWS_AS(HalfEdges(F, 5), InvalidMesh);
    F.row(2) << 1, 0, 4;
    CHECK_THROWS_AS(HalfEdges(F, 5), InvalidMesh);
}
