#include "morph/mesh/geometry.h"

#include "morph/mesh/admit.h"
#include "tests/catch.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

TEST_CASE("the unit cube has area 6, volume 1 and its centre in the middle, wherever it is") {
    for (const double shift : {0.0, -3.0, 1e6}) {
        Mesh mesh = admit(cube(), "cube").mesh;
        mesh.V.array() += shift;
        CHECK(triangle_areas(mesh).sum() == Approx(6.0).epsilon(1e-9));
        CHECK(vertex_areas(mesh).sum() == Approx(6.0).epsilon(1e-9));
        CHECK(signed_volume(mesh) == Approx(1.0).epsilon(1e-9));
        CHECK((centre_of_mass(mesh).array() - (shift + 0.5)).abs().maxCoeff() <
              1e-9 * (1.0 + std::abs(shift)));
        CHECK(bounding_box_diagonal(mesh.V) == Approx(std::sqrt(3.0)).epsilon(1e-9));
    }
}

TEST_CASE("normals at the corners of a cube point along its diagonals, however the squares are split") {
    const Mesh mesh = admit(cube(), "cube").mesh;
    const Points normals = vertex_normals(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const Eigen::RowVector3d diagonal = (mesh.V.row(v).array() - 0.5).matrix().normalized();
        CHECK((normals.row(v) - diagonal).norm() < 1e-14);
    }
}

TEST_CASE(
    "a sphere's area and volume converge with the square of the edge length, its normals with the edge "
    "length") {
    struct Errors {
        double area, volume, normal;
    };
    const auto errors = [](int levels) {
        const Mesh mesh = sphere(levels);
        const Points normals = vertex_normals(mesh);
        CHECK(centre_of_mass(mesh).norm() < 1e-14);
        CHECK((normals.rowwise().norm().array() - 1.0).abs().maxCoeff() < 1e-14);
        return Errors{4 * M_PI - triangle_areas(mesh).sum(), 4 * M_PI / 3 - signed_volume(mesh),
                      (normals - mesh.V).rowwise().norm().maxCoeff()};
    };
    const Errors coarse = errors(4), fine = errors(5);
    CHECK(coarse.area / fine.area == Approx(4.0).epsilon(0.02));
    CHECK(coarse.volume / fine.volume == Approx(4.0).epsilon(0.02));
    CHECK(fine.area < 0.02);
    CHECK(fine.volume < 0.01);
    CHECK(coarse.normal / fine.normal == Approx(2.0).epsilon(0.02));
}

TEST_CASE("a surface turned inside out has the opposite volume and normals") {
    const Mesh out = sphere(2);
    Mesh in = out;
    in.F.col(1).swap(in.F.col(2));
    CHECK(signed_volume(in) == Approx(-signed_volume(out)).epsilon(1e-14));
    CHECK((vertex_normals(in) + vertex_normals(out)).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("a mesh without area has zero normals and the mean of its vertices as centre") {
    Mesh mesh;
    mesh.V = Points{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}};
    mesh.F = Triangles{{0, 1, 2}};
    CHECK(vertex_normals(mesh).norm() == 0.0);
    CHECK((centre_of_mass(mesh) - Eigen::Vector3d::Constant(4.0 / 3.0)).norm() < 1e-15);
    CHECK(bounding_box_diagonal(Points(0, 3)) == 0.0);
}

TEST_CASE("zero-area triangles do not disturb the normals of their neighbours") {
    Mesh mesh;
    mesh.V = Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    mesh.F = Triangles{{0, 2, 3}, {0, 1, 2}};
    const Points normals = vertex_normals(mesh);
    CHECK(normals.row(0) == Eigen::RowVector3d(0, 0, 1));
    CHECK(normals.row(1).norm() == 0.0);
}
