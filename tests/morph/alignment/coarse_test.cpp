#include "morph/alignment/coarse.h"

#include <Eigen/Geometry>
#include <set>

#include "morph/alignment/nonrigid.h"
#include "morph/alignment/places.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/geometry.h"
#include "morph/morph.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

const Eigen::Vector3d kAxes{1.0, 0.7, 0.5};

std::vector<std::vector<int>> loops_of(const Mesh& mesh) {
    return boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count()));
}

Points rows(const Points& V, const std::vector<int>& which) {
    return V(which, Eigen::all);
}

}  // namespace

TEST_CASE("a thinned out mesh is a mesh of the same kind near the first") {
    for (const double opening : {0.0, 0.3}) {
        const Mesh mesh = ellipsoid(kAxes, {.triangles = 12000}, opening);
        const auto loops = loops_of(mesh);
        REQUIRE(loops.empty() == (opening == 0.0));
        const CoarseMesh coarse = coarse_mesh(mesh, loops, 1000);
        CHECK(coarse.mesh.vertex_count() >= 1000);
        CHECK(coarse.mesh.vertex_count() < 1300);  // the border comes on top
        CHECK(coarse.mesh.V == rows(mesh.V, coarse.vertex));
        const Connectivity topology = connectivity(coarse.mesh.F, coarse.mesh.vertex_count());
        CHECK(euler_characteristic(topology) == (loops.empty() ? 2 : 1));
        // The same border, in the same direction.
        REQUIRE(coarse.loops.size() == loops.size());
        const auto found = loops_of(coarse.mesh);
        for (std::size_t k = 0; k < loops.size(); ++k) {
            CHECK(rows(coarse.mesh.V, coarse.loops[k]) == rows(mesh.V, loops[k]));
            CHECK(std::set<int>(found[k].begin(), found[k].end()) ==
                  std::set<int>(coarse.loops[k].begin(), coarse.loops[k].end()));
            CHECK(found[k].size() == loops[k].size());
        }
        // Nowhere far from it.
        const auto places = places_on(coarse.mesh, mesh.V, Points::Zero(mesh.vertex_count(), 3));
        double farthest = 0.0;
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            farthest = std::max(
                farthest, (places[static_cast<std::size_t>(v)].in(coarse.mesh.V) - mesh.V.row(v)).norm());
        }
        CHECK(farthest < 0.01 * bounding_box_diagonal(mesh.V));
    }
}

TEST_CASE("an affine motion of the coarse mesh is carried over as it is") {
    const Mesh mesh = ellipsoid(kAxes, {.triangles = 12000});
    const CoarseMesh coarse = coarse_mesh(mesh, {}, 500);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    const auto moved = [&](const Points& V) -> Points {
        return (1.3 * V * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2);
    };
    const Points carried_over = carried(coarse.mesh, moved(coarse.mesh.V), mesh.V, vertex_normals(mesh));
    // The plain shift that keeps flat fans solvable takes a little of it.
    CHECK((carried_over - moved(mesh.V)).rowwise().norm().maxCoeff() < 2e-4);
}

TEST_CASE("a smooth motion is carried over to second order of the coarse edges", "[sweep]") {
    const Mesh mesh = ellipsoid(kAxes, {.triangles = 40000});
    const auto moved = [](const Points& V) {
        Points W = V;
        W.col(0).array() += 0.1 * (2.0 * V.col(1).array()).sin();
        W.col(2).array() += 0.1 * (2.0 * V.col(0).array() + V.col(1).array()).cos();
        return W;
    };
    double error[2];
    for (const int k : {0, 1}) {
        const CoarseMesh coarse = coarse_mesh(mesh, {}, k == 0 ? 500 : 2000);
        const Points carried_over = carried(coarse.mesh, moved(coarse.mesh.V), mesh.V, vertex_normals(mesh));
        error[k] = (carried_over - moved(mesh.V)).rowwise().norm().mean();
    }
    INFO(error[0] << " with 500 vertices, " << error[1] << " with 2000");
    CHECK(error[0] < 5e-4);
    CHECK(error[1] < 0.4 * error[0]);
}

TEST_CASE("a thinned out alignment is nearly as good as one of all vertices", "[sweep]") {
    const Mesh source = star({.arms = 4, .inner = 0.6, .depth = 0.5}, {.triangles = 8000, .seed = 1});
    Mesh target = star({.arms = 4, .inner = 0.6, .depth = 0.5}, {.triangles = 8000, .seed = 2});
    const auto warped = [](const Points& V) {
        Points W = V;
        W.col(0).array() += 0.09 * (2.1 * V.col(1).array() + 0.4).sin();
        W.col(1).array() += 0.09 * (1.7 * V.col(2).array() - 1.3 * V.col(0).array()).sin();
        return W;
    };
    target.V = warped(target.V);
    double error[3];
    for (const int k : {0, 1, 2}) {
        NonRigidOptions options;
        options.vertices = k == 1 ? 1200 : 1 << 20;
        options.coarse_levels = k == 2 ? 3 : 0;
        options.coarse_vertices = 2000;
        const Points x = align_nonrigid(source, {}, source.V, target, {}, options).x;
        error[k] = 100.0 * (x - warped(source.V)).rowwise().norm().mean() / bounding_box_diagonal(target.V);
    }
    INFO(error[0] << " % with all vertices, " << error[1] << " % with 1200, " << error[2]
                  << " % with 2000 on the coarse levels");
    CHECK(error[1] < error[0] + 0.15);
    CHECK(error[2] < error[0] + 0.05);
}
