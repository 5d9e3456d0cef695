#include "morph/overlay/lift.h"

#include <cmath>
#include <random>

#include "morph/mesh/geometry.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

double unit_random(std::mt19937_64& random) {
    return static_cast<double>(random() >> 11) * 0x1p-53;
}

Site random_site(std::mt19937_64& random) {
    const double u = 0.05 + unit_random(random), v = 0.05 + unit_random(random),
                 w = 0.05 + unit_random(random);
    const double sum = u + v + w;
    return {{0, 1, 2}, {u / sum, v / sum, w / sum}, 3};
}

struct Patch {
    Points V{3, 3}, normals{3, 3};
};

/// A triangle on the unit sphere within 0.4 rad; `outwards` false turns the sphere inside out.
Patch sphere_patch(std::mt19937_64& random, bool outwards) {
    Patch patch;
    for (int i = 0; i < 3; ++i) {
        const double angle = 2.0 * M_PI * (i + 0.5 * unit_random(random)) / 3.0,
                     r = 0.1 + 0.3 * unit_random(random);
        patch.V.row(i) << std::sin(r) * std::cos(angle), std::sin(r) * std::sin(angle), std::cos(r);
    }
    patch.normals = outwards ? patch.V : Points(-patch.V);
    return patch;
}

}  // namespace

TEST_CASE("a sphere lifted with its exact normals stays a sphere") {
    std::mt19937_64 random(1);
    for (const bool outwards : {true, false}) {
        for (int i = 0; i < 300; ++i) {
            const Patch patch = sphere_patch(random, outwards);
            const Points lifted = lift(patch.V, patch.normals, {random_site(random)});
            CHECK(std::abs(lifted.row(0).norm() - 1.0) < 1e-9);
        }
    }
}

TEST_CASE("on a plane the lift is zero") {
    std::mt19937_64 random(2);
    Points V(3, 3), normals(3, 3);
    V << 0, 0, 0, 3, 0, 0, 1, 2, 0;
    normals << 0, 0, 1, 0, 0, 1, 0, 0, 1;
    for (int i = 0; i < 50; ++i) {
        const Site site = random_site(random);
        CHECK((lift(V, normals, {site}) - place(V, {site})).norm() < 1e-15);
    }
}

TEST_CASE("on a saddle the lift of an edge bends with the edge: up along one axis, down along the other") {
    // z = (x^2 - y^2) / 2 with exact normals.
    const auto point = [](double x, double y) { return Eigen::RowVector3d(x, y, 0.5 * (x * x - y * y)); };
    const auto normal = [](double x, double y) { return Eigen::RowVector3d(-x, y, 1).normalized(); };
    const double h = 0.1;
    for (const bool along_x : {true, false}) {
        Points V(2, 3), normals(2, 3);
        V << point(along_x ? h : 0, along_x ? 0 : h), point(along_x ? -h : 0, along_x ? 0 : -h);
        normals << normal(along_x ? h : 0, along_x ? 0 : h), normal(along_x ? -h : 0, along_x ? 0 : -h);
        const Points lifted = lift(V, normals, {Site{{0, 1, -1}, {0.5, 0.5, 0}, 2}});
        // The chord's middle is h^2 / 2 off the surface; the lift removes all but higher orders of it.
        CHECK(std::abs(lifted(0, 2)) < 0.01 * 0.5 * h * h);
    }
}

TEST_CASE("the lift is continuous across an edge, also beside a corner without a normal") {
    std::mt19937_64 random(3);
    for (int i = 0; i < 200; ++i) {
        Patch patch = sphere_patch(random, true);
        if (i % 2 == 1) patch.normals.row(2).setZero();
        for (int k = 0; k < 3; ++k) {
            const double t = 0.01 + 0.98 * unit_random(random), e = 1e-10;
            const int from = k, to = (k + 1) % 3, apex = (k + 2) % 3;
            const Site edge{{from, to, -1}, {1 - t, t, 0}, 2};
            const Site inside{{from, to, apex}, {(1 - t) * (1 - e), t * (1 - e), e}, 3};
            const Points lifted = lift(patch.V, patch.normals, {edge, inside});
            CHECK((lifted.row(0) - lifted.row(1)).norm() < 1e-8);
        }
    }
}

TEST_CASE("vertices are placed bit for bit") {
    std::mt19937_64 random(4);
    const Patch patch = sphere_patch(random, true);
    const Points vertex = lift(patch.V, patch.normals, {Site{{1, -1, -1}, {1, 0, 0}, 1}});
    CHECK(vertex.row(0) == patch.V.row(1));
}

TEST_CASE("what ends in a corner without a normal stays flat, and the patch leaves it gently") {
    std::mt19937_64 random(5);
    for (int i = 0; i < 100; ++i) {
        Patch patch = sphere_patch(random, true);
        const Site inside = random_site(random);
        const double whole = (lift(patch.V, patch.normals, {inside}) - place(patch.V, {inside})).norm();
        patch.normals.row(2).setZero();
        const double t = unit_random(random);
        const Site edge{{0, 2, -1}, {1 - t, t, 0}, 2};
        CHECK((lift(patch.V, patch.normals, {edge}) - place(patch.V, {edge})).norm() < 1e-15);
        const double part = (lift(patch.V, patch.normals, {inside}) - place(patch.V, {inside})).norm();
        CHECK(part > 0);
        CHECK(part < whole);
        // Half-way to that corner less than half the height is left: it does not end in the tip of a cone.
        Site nearer = inside;
        for (double& weight : nearer.weights) weight *= 0.5;
        nearer.weights[2] += 0.5;
        CHECK((lift(patch.V, patch.normals, {nearer}) - place(patch.V, {nearer})).norm() < 0.5 * part);
        patch.normals.row(1).setZero();
        CHECK((lift(patch.V, patch.normals, {inside}) - place(patch.V, {inside})).norm() < 1e-15);
    }
}

TEST_CASE("a corner normal that faces away bounds the lift instead of sending the point to infinity") {
    Points V(2, 3), normals(2, 3);
    V << 0, 0, 0, 1, 0, 0;
    normals << 0, 0.999, 0.0447, 0, -0.999, 0.0447;
    const Points lifted = lift(V, normals, {Site{{0, 1, -1}, {0.5, 0.5, 0}, 2}});
    CHECK((lifted.row(0) - Eigen::RowVector3d(0.5, 0, 0)).norm() < 0.5);
}

TEST_CASE("a smooth mesh keeps its normals for the lift, the edges of a solid have none") {
    const Mesh smooth = ellipsoid({1.0, 0.8, 0.6}, {.triangles = 1000});
    CHECK(smooth_normals(smooth) == vertex_normals(smooth));

    // A cube with the middles of its faces as vertices: those are smooth, its corners are not.
    Mesh cube;
    cube.V.resize(14, 3);
    for (int v = 0; v < 8; ++v) cube.V.row(v) << (v & 1), (v >> 1 & 1), (v >> 2 & 1);
    const int faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                             {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    cube.F.resize(24, 3);
    for (int f = 0; f < 6; ++f) {
        cube.V.row(8 + f) = 0.5 * (cube.V.row(faces[f][0]) + cube.V.row(faces[f][2]));
        for (int k = 0; k < 4; ++k) cube.F.row(4 * f + k) << 8 + f, faces[f][k], faces[f][(k + 1) % 4];
    }
    const Points normals = smooth_normals(cube);
    CHECK(normals.topRows(8).isZero(0.0));
    CHECK(normals.bottomRows(6) == vertex_normals(cube).bottomRows(6));
    // So that every point of its faces stays on them.
    const Site site{{8, faces[0][0], faces[0][1]}, {0.2, 0.5, 0.3}, 3};
    CHECK(lift(cube.V, normals, {site}) == place(cube.V, {site}));
}

TEST_CASE("composing a site of a refined mesh gives the same point on the original") {
    std::mt19937_64 random(5);
    Points V(3, 3);
    V << 0, 0, 0, 4, 0, 1, 1, 3, 2;
    // A refined triangle: a vertex, a point of an edge, a point of the inside.
    const std::vector<Site> refined{
        {{2, -1, -1}, {1, 0, 0}, 1}, {{0, 1, -1}, {0.25, 0.75, 0}, 2}, random_site(random)};
    const Points corners = place(V, refined);
    for (int i = 0; i < 50; ++i) {
        const Site site = random_site(random);
        CHECK((place(V, {compose(site, refined)}) - place(corners, {site})).norm() < 1e-14);
    }
    CHECK(compose({{0, -1, -1}, {1, 0, 0}, 1}, refined).count == 1);
}
