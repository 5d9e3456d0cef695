#include "morph/parameterization/disk_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iostream>

#include "morph/exact/predicates.h"
#include "morph/mesh/admit.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/parameterization/border.h"
#include "morph/parameterization/fill.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

namespace {

struct Disk {
    Mesh mesh;
    std::vector<int> loop;
    Points border;
};

/// The mesh with its border at its arc-length angles.
Disk with_border(const Mesh& mesh, const std::vector<int>& loop) {
    return {mesh, loop, border_rays(arc_length_angles(loop_points(mesh, loop), 0))};
}

Disk with_border(const Mesh& mesh) {
    return with_border(mesh, boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count())).at(0));
}

DiskMap map(const Disk& disk, MapWeights first = MapWeights::Cotangent) {
    return disk_map(disk.mesh, disk.loop, disk.border, {first});
}

int exact_flips(const Mesh& mesh, const Points& rays) {
    int flips = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        flips +=
            orientation(rays.row(mesh.F(f, 0)), rays.row(mesh.F(f, 1)), rays.row(mesh.F(f, 2))) <= 0 ? 1 : 0;
    }
    return flips;
}

double largest_difference(const Points& a, const Points& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("cotangent and mean value weights reproduce a flat disk whose border lies on the circle") {
    // Both have linear precision: the flat positions themselves solve the equations.
    for (const int rings : {2, 7, 40}) {
        const Mesh mesh = disks::flat(rings, 0.3, 5);
        const Disk disk = with_border(mesh);
        Points expected = mesh.V;
        expected.col(2).setOnes();
        for (const MapWeights weights : {MapWeights::Cotangent, MapWeights::MeanValue}) {
            const DiskMap result = map(disk, weights);
            CHECK(result.weights == weights);
            CHECK(result.reason.empty());
            CHECK(largest_difference(result.rays, expected) < 1e-12);
            CHECK(result.residual < 1e-13);
            CHECK(result.quality.flipped == 0);
            // Areas are kept up to the common factor: every ratio is 1.
            CHECK(result.quality.p01 == Approx(1.0).epsilon(1e-9));
            CHECK(result.quality.smallest_ratio == Approx(1.0).epsilon(1e-9));
        }
    }
}

TEST_CASE("uniform weights put every free vertex at the mean of its neighbours") {
    const Disk disk = with_border(disks::dome(9, 1.0));
    const DiskMap result = map(disk, MapWeights::Uniform);
    CHECK(result.weights == MapWeights::Uniform);
    Points sum = Points::Zero(disk.mesh.vertex_count(), 3);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(disk.mesh.vertex_count());
    for (int f = 0; f < disk.mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            sum.row(disk.mesh.F(f, k)) += result.rays.row(disk.mesh.F(f, (k + 1) % 3));
            count[disk.mesh.F(f, k)] += 1.0;
        }
    }
    std::vector<bool> border(static_cast<std::size_t>(disk.mesh.vertex_count()), false);
    for (const int v : disk.loop) border[static_cast<std::size_t>(v)] = true;
    for (int v = 0; v < disk.mesh.vertex_count(); ++v) {
        if (!border[static_cast<std::size_t>(v)])
            CHECK((sum.row(v) / count[v] - result.rays.row(v)).norm() < 1e-14);
    }
}

TEST_CASE("the border stays where it is put and the map does not depend on scale, place or numbering") {
    const Disk disk = with_border(disks::dome(12, 1.5));
    for (const MapWeights weights : {MapWeights::Cotangent, MapWeights::MeanValue, MapWeights::Uniform}) {
        const DiskMap result = map(disk, weights);
        for (std::size_t k = 0; k < disk.loop.size(); ++k) {
            CHECK(result.rays.row(disk.loop[k]) == disk.border.row(static_cast<Eigen::Index>(k)));
        }
        Disk scaled = disk;
        scaled.mesh.V *= 1e-5;
        scaled.mesh.V.rowwise() += Eigen::RowVector3d(1e-5, -2e-5, 3e-5);
        CHECK(largest_difference(map(scaled, weights).rays, result.rays) < 1e-11);
        const auto [mesh, new_index] = disks::renumbered(disk.mesh, 3);
        Disk other{mesh, disk.loop, disk.border};
        for (int& v : other.loop) v = new_index[static_cast<std::size_t>(v)];
        const Points rays = map(other, weights).rays;
        double difference = 0.0;
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            difference = std::max(
                difference, (rays.row(new_index[static_cast<std::size_t>(v)]) - result.rays.row(v)).norm());
        }
        CHECK(difference < 1e-12);
    }
}

TEST_CASE("a map without free vertices is the border itself") {
    for (const int n : {3, 4, 23}) {
        const DiskMap result = map(with_border(disks::polygon(n)));
        CHECK(result.quality.flipped == 0);
        CHECK(result.reason.empty());
    }
}

TEST_CASE("obtuse triangles that flip the harmonic map are caught and mean value weights are used instead") {
    // Pulled far sideways the inner vertex gets negative cotangent weights.
    Mesh mesh = disks::flat(3);
    for (int v = 1; v <= 6; ++v) mesh.V(v, 0) *= 40.0;
    mesh.V(0, 2) = 0.3;
    const DiskMap result = map(with_border(mesh));
    CHECK(result.quality.flipped == 0);
    CHECK(exact_flips(mesh, result.rays) == 0);
    CHECK(result.weights == MapWeights::MeanValue);
    CHECK(result.reason.find("cotangent weights flip ") == 0);
    CHECK(result.residual < 1e-12);
}

TEST_CASE("triangles without area and edges without length do not break the map") {
    for (const MapWeights weights : {MapWeights::Cotangent, MapWeights::MeanValue, MapWeights::Uniform}) {
        SECTION(std::string("first choice ") + name(weights)) {
            Mesh mesh = disks::dome(8, 0.5);
            mesh.V.row(3) = mesh.V.row(4);                             // an edge of no length
            mesh.V.row(20) = 0.5 * (mesh.V.row(19) + mesh.V.row(21));  // three vertices in a line
            const DiskMap result = map(with_border(mesh), weights);
            CHECK(result.quality.flipped == 0);
            CHECK(exact_flips(mesh, result.rays) == 0);
            if (result.weights != MapWeights::Uniform) CHECK(result.guarded > 0);
        }
    }
    SECTION("all inner vertices in one place") {
        Mesh mesh = disks::flat(4);
        for (int v = 1; v < 37; ++v) mesh.V.row(v) = mesh.V.row(0);
        const DiskMap result = map(with_border(mesh));
        CHECK(exact_flips(mesh, result.rays) == 0);
    }
    SECTION("all vertices in one place") {
        Mesh mesh = disks::flat(4);
        mesh.V.setConstant(2.0);
        const DiskMap result = map(with_border(mesh));
        CHECK(exact_flips(mesh, result.rays) == 0);
    }
}

TEST_CASE(
    "a finger that doubles cannot hold is repaired, and what cannot be repaired is an error with counts") {
    const DiskMap easy = map(with_border(disks::finger(10, 0.5)));
    CHECK(easy.quality.flipped == 0);
    CHECK(easy.repaired == 0);

    const Disk deep = with_border(disks::finger(40, 3.0));
    const DiskMap repaired = map(deep);
    CHECK(repaired.quality.flipped == 0);
    CHECK(exact_flips(deep.mesh, repaired.rays) == 0);
    CHECK(repaired.repaired > 0);
    CHECK(repaired.reason.find("uniform weights flip") != std::string::npos);
    CHECK(repaired.reason.find("were moved one by one") != std::string::npos);
    for (std::size_t k = 0; k < deep.loop.size(); ++k) {
        CHECK(repaired.rays.row(deep.loop[k]) == deep.border.row(static_cast<Eigen::Index>(k)));
    }

    try {
        map(with_border(disks::finger(200, 3.0)));
        FAIL("if this can be mapped now, make the finger longer");
    } catch (const SolverFailure& error) {
        CHECK(std::string(error.what()).find("remain after repair") != std::string::npos);
        CHECK(std::string(error.what()).find("601 vertices") != std::string::npos);
    }
}

TEST_CASE("what is not a disk with the given border is refused with the counts") {
    const Disk disk = with_border(disks::flat(3));
    Mesh opened = disk.mesh;
    opened.F.conservativeResize(opened.triangle_count() - 1, 3);
    CHECK_THROWS_AS(disk_map(opened, disk.loop, disk.border), InvalidMesh);
    Mesh unused = disk.mesh;
    unused.V.conservativeResize(unused.vertex_count() + 1, 3);
    unused.V.bottomRows(1).setZero();
    CHECK_THROWS_AS(disk_map(unused, disk.loop, disk.border), InvalidMesh);
    CHECK_THROWS_AS(disk_map(disk.mesh, disk.loop, disk.border.topRows(5)), InvalidMesh);
}

TEST_CASE("map quality measures known area ratios") {
    // Two triangles of equal area in 3D; in the plane one has three times the other's area.
    Mesh mesh;
    mesh.V.resize(4, 3);
    mesh.V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0;
    mesh.F.resize(2, 3);
    mesh.F << 0, 1, 2, 0, 3, 1;
    Points rays(4, 3);
    rays << 0, 0, 1, 1, 0, 1, 0, 3, 1, 0, -1, 1;
    const MapQuality quality = map_quality(mesh, rays);
    CHECK(quality.flipped == 0);
    CHECK(quality.smallest_ratio == Approx(0.5).epsilon(1e-14));
    CHECK(quality.p01 == Approx(0.5).epsilon(1e-14));
    CHECK(quality.area.median == Approx(1.5).epsilon(1e-14));  // 3/4 of the disk over 1/2 of the surface
    CHECK(quality.area.p95 == Approx(2.0).epsilon(1e-14));
    CHECK(quality.area.worst == Approx(2.0).epsilon(1e-14));
    CHECK(quality.angle.median == Approx(1.0).epsilon(1e-14));  // one is kept, one stretched threefold
    CHECK(quality.angle.p95 == Approx(3.0).epsilon(1e-14));
    CHECK(quality.angle.worst == Approx(3.0).epsilon(1e-14));
    rays(3, 1) = 1.0;  // folded over
    CHECK(map_quality(mesh, rays).flipped == 1);
    rays(3, 1) = 0.0;  // flat
    CHECK(map_quality(mesh, rays).flipped == 1);
}

TEST_CASE("the map of every disk among the demo meshes is one-to-one") {
    const std::filesystem::path folder = AUTOMORPH_DEMO_MESHES;
    if (!std::filesystem::exists(folder)) {
        WARN("no demo meshes in " << folder << ": install libcgal-demo and link its data/meshes there");
        return;
    }
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".off") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    int maps = 0;
    std::cout << fmt::format("{:<34} {:>8} {:>6} {:>7} {:<11} {:>8} {:>8} {:>8} {:>6}  {}\n", "mesh",
                             "vertices", "border", "filled", "weights", "p01", "smallest", "residual", "s",
                             "reason");
    for (const auto& file : files) {
        Mesh mesh;
        try {
            const AdmittedMesh admitted = admit(read_mesh(file), file.filename().string());
            if (admitted.admitted.closed) continue;
            mesh = admitted.mesh;
        } catch (const Error&) {
            continue;  // genus, several components: tested elsewhere
        }
        const auto loops = boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count()));
        const FilledMesh filled = fill_openings(mesh, {loops.begin() + 1, loops.end()});
        INFO(file.filename());
        const Disk disk = with_border(filled.mesh, loops[0]);
        const std::clock_t begin = std::clock();
        const DiskMap result = map(disk);
        const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        std::cout << fmt::format("{:<34} {:>8} {:>6} {:>7} {:<11} {:>8.1e} {:>8.1e} {:>8.1e} {:>6.2f}  {}\n",
                                 file.filename().string(), disk.mesh.vertex_count(), disk.loop.size(),
                                 loops.size() - 1, name(result.weights), result.quality.p01,
                                 result.quality.smallest_ratio, result.residual, seconds, result.reason);
        CHECK(exact_flips(disk.mesh, result.rays) == 0);
        CHECK(result.quality.flipped == 0);
        CHECK(result.quality.p01 > 0.0);
        CHECK(result.residual < 1e-10);
        CHECK(result.reason.empty() == (result.weights == MapWeights::Cotangent && result.repaired == 0));
        ++maps;
    }
    CHECK(maps >= 20);
}
