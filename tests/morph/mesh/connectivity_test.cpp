#include "morph/mesh/connectivity.h"

#include "morph/mesh/admit.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

/// Signed area of a loop in the plane z = 0: positive if it runs counter-clockwise.
double loop_area(const Mesh& mesh, const std::vector<int>& loop) {
    double twice = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto p = mesh.V.row(loop[i]), q = mesh.V.row(loop[(i + 1) % loop.size()]);
        twice += p[0] * q[1] - p[1] * q[0];
    }
    return 0.5 * twice;
}

}  // namespace

TEST_CASE("the border of a square facing up runs counter-clockwise, from its first vertex") {
    const Mesh mesh = grid(4);
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    const auto loops = boundary_loops(mesh, topology);
    REQUIRE(loops.size() == 1);
    CHECK(loops[0].size() == 16);
    CHECK(loops[0].front() == 0);
    CHECK(loop_area(mesh, loops[0]) == Approx(16.0));
    CHECK(euler_characteristic(topology) == 1);
    Mesh down = mesh;
    down.F.col(1).swap(down.F.col(2));
    const auto reversed = boundary_loops(down, connectivity(down.F, down.vertex_count()));
    CHECK(loop_area(down, reversed[0]) == Approx(-16.0));
}

TEST_CASE("loops are ordered by length, holes run clockwise, and every loop follows its triangles' sides") {
    const Mesh mesh =
        admit(polygon_soup(grid(
                  9,
                  [](int i, int j) { return (i == 2 && j == 2) || (i >= 5 && i <= 6 && j >= 4 && j <= 6); })),
              "plate")
            .mesh;
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    const auto loops = boundary_loops(mesh, topology);
    REQUIRE(loops.size() == 3);
    CHECK(loop_area(mesh, loops[0]) == Approx(81.0));
    CHECK(loop_area(mesh, loops[1]) == Approx(-6.0));
    CHECK(loop_area(mesh, loops[2]) == Approx(-1.0));
    CHECK(euler_characteristic(topology) == -1);
    for (const auto& loop : loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const int from = loop[i], to = loop[(i + 1) % loop.size()];
            int sides = 0;
            for (const auto& f : mesh.F.rowwise()) {
                for (int k = 0; k < 3; ++k) sides += f[k] == from && f[(k + 1) % 3] == to ? 1 : 0;
            }
            CHECK(sides == 1);
        }
    }
}

TEST_CASE("handles carry the indices of the mesh") {
    const Mesh mesh = sphere(2);
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    CHECK(euler_characteristic(topology) == 2);
    CHECK(boundary_loops(mesh, topology).empty());
    REQUIRE(static_cast<int>(topology.n_faces()) == mesh.triangle_count());
    for (const auto face : topology.faces()) {
        int k = 0;
        for (const auto vertex : face.vertices()) {
            bool found = false;
            for (int j = 0; j < 3; ++j) found = found || mesh.F(face.idx(), j) == vertex.idx();
            CHECK(found);
            ++k;
        }
        CHECK(k == 3);
    }
}

TEST_CASE("a triangle that does not fit is named") {
    const Triangles against{{0, 1, 2}, {0, 1, 3}};
    CHECK(contains(error_of<InvalidMesh>([&] { connectivity(against, 4); }), "triangle 1 (0 1 3)"));
    const Triangles three{{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    CHECK(contains(error_of<InvalidMesh>([&] { connectivity(three, 5); }), "triangle 2 (0 1 4)"));
}
