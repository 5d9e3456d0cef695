#include "render/geometry/embree_scene.h"

#include <string>

#include "morph/mesh/errors.h"
#include "tests/catch.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

TEST_CASE("rays find the first triangle and its distance, shadow rays anything before their end") {
    const Shape low = square(1.0, 0.0), high = square(0.5, 1.0);
    const TriangleMesh a(low.V, low.F, Normals::Flat), b(high.V, high.F, Normals::Flat);
    EmbreeScene scene("");
    scene.attach(0, a);
    scene.attach(5, b);
    scene.commit();
    {
        const Hit hit = scene.intersect({{0.3f, 0.1f, 3.0f}, {0, 0, -2}}, 1e9f).value();
        CHECK(hit.mesh == 5);
        CHECK(hit.triangle == 0);
        CHECK(hit.distance == Approx(1.0f));
        const Hit beside = scene.intersect({{-0.9f, 0.1f, 3.0f}, {0, 0, -1}}, 1e9f).value();
        CHECK(beside.mesh == 0);
        CHECK(beside.triangle == 1);
        CHECK(beside.distance == Approx(3.0f));
        CHECK_FALSE(scene.intersect({{1.1f, 0.1f, 3.0f}, {0, 0, -1}}, 1e9f).has_value());
        CHECK_FALSE(scene.intersect({{-0.9f, 0.1f, 3.0f}, {0, 0, -1}}, 2.9f).has_value());
    }
    CHECK(scene.occluded({{0.3f, 0.1f, 3.0f}, {0, 0, -1}}, 2.1f));
    CHECK_FALSE(scene.occluded({{0.3f, 0.1f, 3.0f}, {0, 0, -1}}, 1.9f));
    CHECK_FALSE(scene.occluded({{0.3f, 0.1f, 3.0f}, {0, 0, 1}}, 1e9f));
}

TEST_CASE("a packet of rays meets what the single rays meet") {
    const Shape sphere = icosphere(3);
    const TriangleMesh mesh(sphere.V, sphere.F, Normals::Flat);
    for (const char* config : {"", "isa=sse4.2"}) {
        EmbreeScene scene(config);
        scene.attach(0, mesh);
        scene.commit();
        int met = 0;
        for (std::size_t count : {1u, 5u, 16u}) {
            RayPacket packet;
            packet.count = count;
            for (std::size_t i = 0; i < count; ++i)
                packet.rays[i] = {{0.1f, -3.0f, 0.2f},
                                  Vec3(0.03f * static_cast<float>(i), 1.0f, 0.01f).normalized()};
            const auto hits = scene.intersect(packet);
            for (std::size_t i = 0; i < hits.size(); ++i) {
                std::optional<Hit> expected;
                if (i < count) expected = scene.intersect(packet.rays[i], 1e30f);
                REQUIRE(hits[i].has_value() == expected.has_value());
                if (!expected) continue;
                ++met;
                CHECK(hits[i]->mesh == expected->mesh);
                CHECK(hits[i]->triangle == expected->triangle);
                CHECK(hits[i]->distance == Approx(expected->distance));
            }
        }
        CHECK(met > 15);
    }
}

TEST_CASE("Embree's errors come as exceptions with its message") {
    const Shape cube = box();
    const TriangleMesh mesh(cube.V, cube.F, Normals::Flat);
    EmbreeScene scene("");
    scene.attach(3, mesh);
    try {
        scene.attach(3, mesh);
        FAIL("no error");
    } catch (const Error& error) {
        const std::string message = error.what();
        INFO(message);
        CHECK(message.find("Embree failed to add a mesh: ") == 0);
        CHECK(message.size() > 45);
    }
}

TEST_CASE("an instruction set that does not exist is refused, since Embree would ignore it") {
    CHECK_THROWS_AS(EmbreeScene("isa=sse4"), ConfigError);
    CHECK_THROWS_AS(EmbreeScene("verbose=0,isa="), ConfigError);
    CHECK_NOTHROW(EmbreeScene("verbose=0,isa=sse4.2,threads=1"));
}

TEST_CASE("smooth normals are weighted by area, so that needles do not count") {
    // A flat square about its centre, and a needle without area to speak of that stands upright on one spoke.
    Points V(6, 3);
    V << 0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0.5, 0, 1e-9;
    Triangles F(5, 3);
    F << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 0, 1, 5;
    const TriangleMesh mesh(V, F, Normals::Smooth);
    for (std::uint32_t f = 0; f < 4; ++f) {
        CHECK((mesh.corner_normals(f)[0] - Vec3(0, 0, 1)).norm() < 1e-6f);
    }
    // A roof of two sides, one twice as large as the other: the ridge leans to the larger one.
    Points roof(4, 3);
    roof << 0, -1, 0, 0, 1, 0, -2, 0, 0, 0, 0, -1;
    Triangles sides(2, 3);
    sides << 0, 1, 2, 1, 0, 3;
    const TriangleMesh leaning(roof, sides, Normals::Smooth);
    const Vec3 expected = Vec3(1, 0, 2).normalized();  // areas 2 and 1, facing z and x
    CHECK((leaning.corner_normals(0)[0] - expected).norm() < 1e-6f);
}

TEST_CASE("given normals are normalised and stay when vertices move, computed ones follow") {
    const Shape cube = box();
    Points V = cube.V;
    V.col(2) *= 3.0;
    TriangleMesh given(cube.V, cube.F, Normals::Smooth, Points::Constant(8, 3, 5.0));
    given.move({V});
    CHECK((given.corner_normals(0)[0] - Vec3::Ones().normalized()).norm() < 1e-6f);
    TriangleMesh computed(cube.V, cube.F, Normals::Smooth);
    computed.move({Points(-cube.V)});
    CHECK((computed.corner_normals(0)[0] - computed.corners(0)[0].normalized()).norm() > 1.0f);
}

TEST_CASE("corrections are added to computed normals of unit length, from the next move on") {
    const Shape cube = box();
    TriangleMesh mesh(cube.V, cube.F, Normals::Smooth);
    const Vec3 before = mesh.corner_normals(0)[0];
    Points corrections = Points::Zero(8, 3);
    corrections.col(2).setConstant(2.0);
    mesh.correct_normals({corrections});
    CHECK((mesh.corner_normals(0)[0] - before).norm() == 0.0f);
    mesh.move({cube.V});
    CHECK((mesh.corner_normals(0)[0] - (before + Vec3(0, 0, 2)).normalized()).norm() < 1e-6f);
    mesh.correct_normals({});
    mesh.move({cube.V});
    CHECK((mesh.corner_normals(0)[0] - before).norm() == 0.0f);
    CHECK_THROWS_AS(mesh.correct_normals({Points::Zero(7, 3)}), InvalidMesh);
    CHECK_THROWS_AS(mesh.correct_normals({corrections, corrections}), InvalidMesh);
}
