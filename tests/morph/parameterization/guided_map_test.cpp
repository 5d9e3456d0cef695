#include "morph/parameterization/guided_map.h"

#include "morph/mesh/connectivity.h"
#include "morph/parameterization/border.h"
#include "morph/parameterization/disk_map.h"
#include "morph/parameterization/map_quality.h"
#include "morph/shapes/random.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

namespace {

struct Mapped {
    Mesh mesh = disks::dome(12, 0.7);
    std::vector<char> fixed = std::vector<char>(static_cast<std::size_t>(mesh.vertex_count()), 0);
    Points rays;

    Mapped() {
        const auto loop = boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count())).at(0);
        for (const int v : loop) fixed[static_cast<std::size_t>(v)] = 1;
        rays = disk_map(mesh, loop, border_rays(arc_length_angles(loop_points(mesh, loop), 0))).rays;
    }

    /// Moves some inner vertices far enough to turn triangles over.
    Points disturbed(int count, double distance) const {
        Random random(9);
        Points places = rays;
        for (int n = 0; n < count;) {
            const int v = static_cast<int>(random.uniform() * mesh.vertex_count());
            if (fixed[static_cast<std::size_t>(v)]) continue;
            places.row(v).head<2>() += distance * random.in_ball<2>();
            ++n;
        }
        return places;
    }
};

}  // namespace

TEST_CASE("a map that is one-to-one already is left alone") {
    const Mapped disk;
    const GuidedMap map = guided_map(disk.mesh, disk.fixed, disk.rays, MapDomain::Disk);
    CHECK(map.rays == disk.rays);
    CHECK(map.flipped_before == 0);
    CHECK(map.moved == 0);
}

TEST_CASE("flipped triangles are turned back by moving few vertices, and the border stays") {
    const Mapped disk;
    const Points places = disk.disturbed(6, 0.25);
    const GuidedMap map = guided_map(disk.mesh, disk.fixed, places, MapDomain::Disk);
    REQUIRE(map.flipped_before > 0);
    CHECK(map.flipped == 0);
    CHECK(flipped_triangles(disk.mesh.F, map.rays) == 0);
    CHECK(map.moved < disk.mesh.vertex_count() / 2);
    int stayed = 0;
    for (int v = 0; v < disk.mesh.vertex_count(); ++v) {
        if (disk.fixed[static_cast<std::size_t>(v)]) CHECK(map.rays.row(v) == places.row(v));
        stayed += map.rays.row(v) == places.row(v);
    }
    CHECK(stayed >= disk.mesh.vertex_count() - map.moved);
}

TEST_CASE("whatever the places, the disk is mapped one-to-one in the end") {
    const Mapped disk;
    Points places = disk.disturbed(400, 1.5);
    CHECK(guided_map(disk.mesh, disk.fixed, places, MapDomain::Disk).flipped == 0);
    for (int v = 0; v < places.rows(); ++v) {
        if (!disk.fixed[static_cast<std::size_t>(v)]) places.row(v) << 0.5, 0.5, 1.0;  // all in one place
    }
    CHECK(guided_map(disk.mesh, disk.fixed, places, MapDomain::Disk).flipped == 0);
}

TEST_CASE("on the sphere a few flips are repaired and rays stay on it") {
    const Mesh mesh = ellipsoid({1, 1, 1}, {.triangles = 2000});
    Points places = mesh.V.rowwise().normalized();
    Random random(2);
    for (const int v : {10, 400, 700})
        places.row(v) = (places.row(v) + 0.3 * random.in_ball<3>().transpose()).normalized();
    const std::vector<char> fixed(static_cast<std::size_t>(mesh.vertex_count()), 0);
    const GuidedMap map = guided_map(mesh, fixed, places, MapDomain::Sphere);
    CHECK(map.flipped_before > 0);
    CHECK(map.flipped == 0);
    CHECK((map.rays.rowwise().norm().array() - 1.0).abs().maxCoeff() < 1e-12);
}
