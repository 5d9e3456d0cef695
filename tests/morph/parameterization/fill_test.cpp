#include "morph/parameterization/fill.h"

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

TEST_CASE("openings are filled by fans that keep the input's numbering") {
    // A disk without its centre and without a square of another ring: two openings.
    Mesh mesh = disks::grid(7, 5);
    const auto left_out = [](int f) {
        return f == 2 * (7 * 1 + 1) || f == 2 * (7 * 3 + 4) || f == 2 * (7 * 3 + 4) + 1;
    };
    Triangles kept(mesh.triangle_count() - 3, 3);
    for (int f = 0, k = 0; f < mesh.triangle_count(); ++f) {
        if (!left_out(f)) kept.row(k++) = mesh.F.row(f);
    }
    mesh.F = kept;
    const auto loops = boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count()));
    REQUIRE(loops.size() == 3);
    const FilledMesh filled = fill_openings(mesh, {loops[1], loops[2]});

    const Connectivity topology = connectivity(filled.mesh.F, filled.mesh.vertex_count());
    CHECK(euler_characteristic(topology) == 1);
    CHECK(boundary_loops(filled.mesh, topology).size() == 1);
    CHECK(filled.mesh.V.topRows(mesh.vertex_count()) == mesh.V);
    CHECK(filled.mesh.F.topRows(mesh.triangle_count()) == mesh.F);
    REQUIRE(filled.centres.size() == 2);
    REQUIRE(static_cast<int>(filled.is_filling.size()) == filled.mesh.triangle_count());
    CHECK(filled.mesh.triangle_count() == mesh.triangle_count() + 4 + 3);
    for (int f = 0; f < filled.mesh.triangle_count(); ++f) {
        CHECK((filled.is_filling[static_cast<std::size_t>(f)] != 0) == (f >= mesh.triangle_count()));
    }
    Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
    for (const int v : loops[1]) mean += mesh.V.row(v) / static_cast<double>(loops[1].size());
    CHECK((filled.mesh.V.row(filled.centres[0]) - mean).norm() < 1e-14);
}

TEST_CASE("a mesh without openings is filled with nothing, and a loop of two vertices is refused") {
    const Mesh mesh = disks::flat(2);
    CHECK(fill_openings(mesh, {}).mesh.F == mesh.F);
    CHECK_THROWS_AS(fill_openings(mesh, {{0, 1}}), InvalidMesh);
    CHECK_THROWS_AS(fill_openings(mesh, {{0, 1, 4711}}), InvalidMesh);
}
