#include "render/studio/studio.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "morph/mesh/errors.h"
#include "render/camera/framing.h"
#include "render/integrator/render.h"
#include "render/studio/backdrop.h"
#include "tests/catch.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

TEST_CASE("the studio shows any shape bright on an even background, whatever its size and place") {
    const Shape sphere = icosphere(3);
    Image first;
    for (double scale : {1.0, 1e-3, 250.0, 3e-11, 1e7}) {
        Points V = scale * sphere.V;
        V.rowwise() += scale * Eigen::RowVector3d(3.0, -1.0, 2.0);
        FramingOptions framing;
        framing.margin = 0.3;
        const Camera camera = frame_all({V}, framing);
        Bounds bounds;
        bounds.add(V);
        Scene scene;
        MeshOptions mesh;
        mesh.material = clay();
        scene.add_mesh(V, sphere.F, mesh);
        add_studio(scene, camera, bounds);
        RenderOptions options;
        options.width = options.height = 64;
        options.spp = 64;
        const RenderResult result = render::render(scene, camera, options);
        CHECK(result.bad_samples == 0);
        // Sky above and ground in front of the shape, which no shadow reaches, are the background; the ground
        // is up to 5 % brighter by the light that the shape reflects onto it.
        for (const auto& [x, y] : {std::pair{3, 3}, std::pair{60, 3}, std::pair{3, 58}}) {
            CHECK(result.image.at(x, y)[1] > 0.99f * StudioOptions{}.background[1]);
            CHECK(result.image.at(x, y)[1] < 1.05f * StudioOptions{}.background[1]);
        }
        // The middle of the shape is bright but not clipped, the shadow side darker.
        CHECK(result.image.at(24, 24)[1] > 0.45f);
        CHECK(result.image.at(24, 24)[1] < 0.95f);
        CHECK(result.image.at(44, 44)[1] < 0.6f * result.image.at(24, 24)[1]);
        if (first.pixels.empty()) first = result.image;
        double difference = 0.0;
        for (std::size_t i = 0; i < first.pixels.size(); ++i) {
            difference += std::abs(first.pixels[i] - result.image.pixels[i]);
        }
        INFO("scale " << scale);
        CHECK(difference / static_cast<double>(first.pixels.size()) < 0.002);
    }
}

TEST_CASE("bounds leave out what is not finite, and empty bounds are refused") {
    Points V(3, 3);
    V << 1, 2, 3, -1, 5, 0, std::numeric_limits<double>::quiet_NaN(), 100, 100;
    Bounds bounds;
    Scene scene;
    CHECK_THROWS_AS(add_studio(scene, {}, bounds), Error);
    bounds.add(V);
    CHECK(bounds.lower == Eigen::Vector3d(-1, 2, 0));
    CHECK(bounds.upper == Eigen::Vector3d(1, 5, 3));
    CHECK(bounds.center() == Eigen::Vector3d(0, 3.5, 1.5));
    add_studio(scene, {}, bounds);
    CHECK(scene.mesh_count() == 1);
    // The ground lies just under the lowest point.
    CHECK(scene.mesh(0).positions(0)[2] == Approx(0.0).margin(0.01));
    CHECK(scene.mesh(0).positions(0)[2] < 0.0f);
}

namespace {

Bounds unit_bounds() {
    Bounds bounds;
    bounds.lower.setConstant(-1);
    bounds.upper.setConstant(1);
    return bounds;
}

FloorPlace level_place() {
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2.0};
}

}  // namespace

TEST_CASE("paper rises without a seam: triangles face its normals, and neighbours share lines and normals") {
    const Backdrop paper = make_backdrop(level_place(), {Color::Constant(0.5f), false, true});
    const Points& N = paper.options.vertex_normals;
    REQUIRE(N.rows() == paper.V.rows());
    double lowest_cosine = 1, highest = 0;
    for (Eigen::Index f = 0; f < paper.F.rows(); ++f) {
        const auto corner = [&](int k) { return Eigen::Vector3d(paper.V.row(paper.F(f, k))); };
        const Eigen::Vector3d normal =
            cross(Eigen::Vector3d(corner(1) - corner(0)), Eigen::Vector3d(corner(2) - corner(0)))
                .normalized();
        for (int k = 0; k < 3; ++k) {
            CHECK(N.row(paper.F(f, k)).norm() == Approx(1));
            lowest_cosine = std::min(lowest_cosine, normal.dot(Eigen::Vector3d(N.row(paper.F(f, k)))));
            highest = std::max(highest, corner(k).z());
        }
    }
    CHECK(lowest_cosine > std::cos(0.07));  // half a step of the bend
    CHECK(highest > 50.0);
    // Vertices at one place have one normal.
    for (Eigen::Index a = 0; a + 4 < N.rows(); a += 4) {
        for (Eigen::Index b = 0; b < N.rows(); b += 37) {
            if ((paper.V.row(a) - paper.V.row(b)).norm() < 1e-9) CHECK((N.row(a) - N.row(b)).norm() < 1e-9);
        }
    }
    // Without a wall it is the floor.
    CHECK(make_backdrop(level_place(), {}).V.col(2).cwiseAbs().maxCoeff() == 0);
}

TEST_CASE("squares alternate near the shape and are gone far from it") {
    const Backdrop floor = make_backdrop(level_place(), {Color::Constant(0.8f), true, false});
    int dark = 0, light = 0;
    for (Eigen::Index v = 0; v < floor.V.rows(); v += 4) {
        const Eigen::RowVector3d middle = floor.V.middleRows(v, 4).colwise().mean();
        const double albedo = floor.options.vertex_colors(v, 0);
        CHECK((floor.options.vertex_colors.middleRows(v, 4).array() == albedo).all());
        if (middle.norm() > 2.0 * 8) CHECK(albedo == Approx(0.8));
        if (middle.norm() > 2.0 * 2.5) continue;
        (albedo < 0.5 ? dark : light) += 1;
        CHECK((albedo == Approx(0.8) || albedo == Approx(0.36)));
    }
    CHECK(dark > 50);
    CHECK(std::abs(dark - light) <= dark / 5);
}

TEST_CASE("a studio's strength and rim act on its lights alone") {
    Scene plain, strong, rimmed;
    StudioOptions options;
    add_studio(plain, {}, unit_bounds(), options);
    options.strength = 2.0f;
    add_studio(strong, {}, unit_bounds(), options);
    options.strength = 1.0f;
    options.rim = 0.5f;
    add_studio(rimmed, {}, unit_bounds(), options);
    REQUIRE(plain.lights.size() == 2);
    REQUIRE(rimmed.lights.size() == 3);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK((strong.lights[i].radiance == 2.0f * plain.lights[i].radiance).all());
        CHECK((rimmed.lights[i].radiance == plain.lights[i].radiance).all());
    }
    CHECK((strong.sky.radiance == 2.0f * plain.sky.radiance).all());
    CHECK((*strong.background == *plain.background).all());
    // From behind, above: the camera of the default looks along +Y.
    CHECK(rimmed.lights[2].center.y() > 1.0f);
    CHECK(rimmed.lights[2].center.z() > 1.0f);
}

TEST_CASE("every ground lies under the shape, and none is none") {
    for (const Ground ground : {Ground::None, Ground::Shadow, Ground::Plain, Ground::Checker}) {
        Scene studio, sky;
        StudioOptions options;
        options.ground = ground;
        add_studio(studio, {}, unit_bounds(), options);
        add_ground(sky, {}, unit_bounds(), ground, Color::Ones());
        CHECK(studio.mesh_count() == (ground == Ground::None ? 0 : 1));
        CHECK(sky.mesh_count() == studio.mesh_count());
        CHECK(sky.lights.empty());
        if (ground == Ground::None) continue;
        CHECK(studio.material(0).shadow_catcher == (ground == Ground::Shadow));
        float highest = -1e9f;
        for (int v = 0; v < sky.mesh(0).vertex_count(); ++v)
            highest = std::max(highest, sky.mesh(0).positions(0)[3 * v + 2]);
        CHECK(highest < -1.0f);
        CHECK(highest > -1.01f);
    }
}
