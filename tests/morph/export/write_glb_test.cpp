#include "morph/export/write_glb.h"

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <numbers>

#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/morph.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"
#include "tests/files.h"
#include "tests/morph/export/glb_reader.h"

using namespace automorph;
using test::GlbFile;

namespace {

const double kAlphas[] = {0.0, 0.1, 0.25, 1.0 / 3, 0.5, 0.618, 0.75, 0.9, 1.0};

/// A sphere and an ellipsoid of another size, turned and moved.
struct Pair {
    Triangles F;
    Endpoints ends;
    double diagonal = 0;
};

Pair turned_pair(double angle, const Eigen::Vector3d& place, double size = 1.0) {
    const Mesh sphere = ellipsoid({1, 1, 1}, {.triangles = 500});
    Pair pair;
    pair.F = sphere.F;
    const Points a = size * sphere.V, b = 1.5 * a * Eigen::Vector3d(1.0, 0.6, 0.8).asDiagonal();
    pair.ends.R = Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    pair.ends.a = a.rowwise() + place.transpose();
    pair.ends.b =
        (b * pair.ends.R.transpose()).rowwise() + (place + size * Eigen::Vector3d(2, -1, 0.5)).transpose();
    pair.ends.centre_a = centre_of_mass({pair.ends.a, pair.F});
    pair.ends.centre_b = centre_of_mass({pair.ends.b, pair.F});
    pair.diagonal = std::max(bounding_box_diagonal(pair.ends.a), bounding_box_diagonal(pair.ends.b));
    return pair;
}

/// From glTF's y up to z up, as Blender does it.
Points z_up(const Points& rows) {
    Points turned(rows.rows(), 3);
    turned << rows.col(0), -rows.col(2), rows.col(1);
    return turned;
}

double largest_distance(const Points& x, const Points& y) {
    REQUIRE(x.rows() == y.rows());
    return (x - y).rowwise().norm().maxCoeff();
}

}  // namespace

TEST_CASE("a .glb plays what the library interpolates, at every time and however the shapes are turned") {
    const TemporaryFolder folder;
    for (const Interpolation scheme :
         {Interpolation::Slerp, Interpolation::Linear, Interpolation::RigidLinear}) {
        // Between its keys the parabolas of RigidLinear are chords: 1 / (2 * 240^2) of their height.
        const double tolerance = scheme == Interpolation::RigidLinear ? 1e-5 : 1e-6;
        for (const double angle : {0.0, 1e-4, 0.4, 2.0, 3.1, std::numbers::pi}) {
            const Pair pair = turned_pair(angle, {3, -2, 1});
            write_glb(folder / "m.glb", pair.F, pair.ends, {.animation = {.scheme = scheme, .seconds = 1.7}});
            const GlbFile glb(folder / "m.glb");
            CHECK(glb.triangles() == pair.F);
            CHECK(glb.duration() == Approx(1.7));
            for (const double alpha : kAlphas) {
                INFO("scheme " << static_cast<int>(scheme) << ", angle " << angle << ", alpha " << alpha);
                const bool end = alpha == 0.0 || alpha == 1.0;
                CHECK(largest_distance(z_up(glb.positions(1.7 * alpha)),
                                       interpolate(pair.ends, alpha, scheme)) <
                      (end ? 1e-6 : tolerance) * pair.diagonal);
            }
        }
    }
}

TEST_CASE("a .glb keeps the detail of shapes far from the origin, tiny and huge") {
    const TemporaryFolder folder;
    const auto check = [&](const Eigen::Vector3d& place, double size) {
        const Pair pair = turned_pair(1.2, place, size);
        write_glb(folder / "m.glb", pair.F, pair.ends);
        const GlbFile glb(folder / "m.glb");
        for (const double alpha : kAlphas) {
            INFO("size " << size << " at " << place.transpose() << ", alpha " << alpha);
            CHECK(largest_distance(z_up(glb.positions(2 * alpha)),
                                   interpolate(pair.ends, alpha, Interpolation::Slerp)) <
                  1e-6 * pair.diagonal);
        }
    };
    check({4.5e5, 5.4e6, 800}, 0.25);  // a scan in metres of a survey's grid
    check({0, 0, 0}, 1e-9);
    check({0, 0, 0}, 1e9);
}

TEST_CASE("a .glb is shaded by the normals of both shapes") {
    const TemporaryFolder folder;
    const Pair pair = turned_pair(2.0, {0, 0, 0});
    write_glb(folder / "m.glb", pair.F, pair.ends);
    const GlbFile glb(folder / "m.glb");
    CHECK(largest_distance(z_up(glb.normals(0)), vertex_normals({pair.ends.a, pair.F})) < 1e-5);
    CHECK(largest_distance(z_up(glb.normals(2)), vertex_normals({pair.ends.b, pair.F})) < 1e-5);
}

TEST_CASE("normals are of unit length where triangles have no area") {
    const TemporaryFolder folder;
    Pair pair = turned_pair(0.5, {0, 0, 0});
    // All triangles of vertex 0 collapse in a, those of vertex 1 in both.
    for (int f = 0; f < pair.F.rows(); ++f) {
        for (const int v : {0, 1}) {
            if ((pair.F.row(f).array() != v).all()) continue;
            for (const int w : pair.F.row(f)) {
                pair.ends.a.row(w) = pair.ends.a.row(v);
                if (v == 1) pair.ends.b.row(w) = pair.ends.b.row(v);
            }
        }
    }
    REQUIRE(vertex_normals({pair.ends.a, pair.F}).row(0).isZero());
    REQUIRE(vertex_normals({pair.ends.b, pair.F}).row(1).isZero());
    write_glb(folder / "m.glb", pair.F, pair.ends);
    const GlbFile glb(folder / "m.glb");
    for (const double time : {0.0, 2.0}) {
        const Eigen::VectorXd lengths = glb.normals(time).rowwise().norm();
        CHECK(lengths.minCoeff() == Approx(1.0));
        CHECK(lengths.maxCoeff() == Approx(1.0));
    }
}

TEST_CASE("ping-pong goes back the way it came, and ends where it began") {
    const TemporaryFolder folder;
    for (const Interpolation scheme : {Interpolation::Slerp, Interpolation::RigidLinear}) {
        const Pair pair = turned_pair(2.5, {1, 0, 0});
        write_glb(folder / "m.glb", pair.F, pair.ends,
                  {.animation = {.scheme = scheme, .seconds = 3, .ping_pong = true}});
        const GlbFile glb(folder / "m.glb");
        CHECK(glb.duration() == Approx(6));
        for (const double alpha : kAlphas) {
            CHECK(largest_distance(glb.positions(3 * alpha), glb.positions(6 - 3 * alpha)) < 1e-6);
        }
        CHECK(largest_distance(z_up(glb.positions(3)), pair.ends.b) < 1e-6 * pair.diagonal);
    }
}

TEST_CASE("the axis that points up is y in the file") {
    const TemporaryFolder folder;
    const Pair pair = turned_pair(1.0, {1, 2, 3});
    write_glb(folder / "z.glb", pair.F, pair.ends, {.up = UpAxis::Z});
    write_glb(folder / "y.glb", pair.F, pair.ends, {.up = UpAxis::Y});
    const Points z = GlbFile(folder / "z.glb").positions(0), y = GlbFile(folder / "y.glb").positions(0);
    CHECK((z.col(1) - pair.ends.a.col(2)).cwiseAbs().maxCoeff() < 1e-6 * pair.diagonal);
    CHECK(largest_distance(y, pair.ends.a) < 1e-6 * pair.diagonal);
}

TEST_CASE("the morph of two shapes arrives in the file, openings and all") {
    const TemporaryFolder folder;
    const auto check = [&](const Mesh& a, const Mesh& b) {
        const Morph m = morph(admit_mesh(a), admit_mesh(b), {.alignment = Alignment::Registration});
        write_glb(folder / "m.glb", m.triangles(), m.endpoints(), {.name = "a \"name\" of \xff bytes"});
        const GlbFile glb(folder / "m.glb");
        CHECK(glb.triangles() == m.triangles());
        const double diagonal = bounding_box_diagonal(m.frame(0));
        for (const double alpha : kAlphas) {
            CHECK(largest_distance(z_up(glb.positions(2 * alpha)), m.frame(alpha)) < 1e-6 * diagonal);
        }
    };
    const Mesh round = ellipsoid({1, 0.8, 0.5}, {.triangles = 400});
    Mesh other = star({}, {.triangles = 600});
    other.V = other.V * Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
    check(round, other);
    Mesh open = round;  // two openings
    open.F = Triangles(round.F.middleRows(4, round.F.rows() - 8));
    check(open, open);
}

TEST_CASE("what a .glb cannot hold is refused and leaves nothing behind") {
    const TemporaryFolder folder;
    const Pair huge = turned_pair(1, {0, 0, 0}, 1e20), tiny = turned_pair(1, {0, 0, 0}, 1e-20),
               good = turned_pair(1, {0, 0, 0});
    CHECK_THROWS_AS(write_glb(folder / "m.glb", huge.F, huge.ends), IoError);
    CHECK_THROWS_AS(write_glb(folder / "m.glb", tiny.F, tiny.ends), IoError);
    CHECK_THROWS_AS(write_glb(folder / "gone/m.glb", good.F, good.ends), IoError);
    CHECK(std::filesystem::is_empty(folder.path()));
    CHECK(is_glb_file("a/b.GLB"));
    CHECK_FALSE(is_glb_file("b.gltf"));
    CHECK_FALSE(is_glb_file("glb"));
}
