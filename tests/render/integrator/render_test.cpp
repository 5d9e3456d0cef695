#include "render/integrator/render.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "morph/mesh/errors.h"
#include "tests/catch.h"
#include "tests/render/picture_mean.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

namespace {

Scene lit_sphere(const SceneOptions& options = {}) {
    const Shape sphere = icosphere(2), plane = square(5.0, -1.0);
    Scene scene(options);
    scene.add_mesh(sphere.V, sphere.F);
    scene.add_mesh(plane.V, plane.F);
    scene.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 1.5f, Color(9.0f, 8.0f, 7.0f)));
    scene.sky.radiance.setConstant(0.2f);
    return scene;
}

RenderOptions options_of(int width, int height, int spp) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.spp = spp;
    return options;
}

}  // namespace

TEST_CASE("the picture has the same bits for any number of threads and any tile size") {
    RenderOptions options = options_of(61, 43, 8);
    options.threads = 1;
    Scene first = lit_sphere();
    const RenderResult expected = render::render(first, {}, options);
    for (int threads : {2, 7, 0}) {
        for (int tile : {5, 16, 64}) {
            options.threads = threads;
            options.tile = tile;
            Scene scene = lit_sphere();  // the tree is built by as many threads, too
            const RenderResult result = render::render(scene, {}, options);
            CHECK(same_bits(result.image, expected.image));
            CHECK(result.rays == expected.rays);
            CHECK(result.samples == 61u * 43u * 8u);
        }
    }
}

TEST_CASE("seed and frame change the noise, and nothing else does") {
    Scene scene = lit_sphere();
    RenderOptions options = options_of(32, 24, 4);
    const Image image = render::render(scene, {}, options).image;
    CHECK(same_bits(render::render(scene, {}, options).image, image));
    options.seed = 1;
    const Image other_seed = render::render(scene, {}, options).image;
    options.seed = 0;
    options.frame = 1;
    const Image other_frame = render::render(scene, {}, options).image;
    CHECK_FALSE(same_bits(other_seed, image));
    CHECK_FALSE(same_bits(other_frame, image));
    CHECK_FALSE(same_bits(other_frame, other_seed));
}

TEST_CASE("a pixel does not depend on the samples of its neighbours") {
    // The left part of a wider picture of the same view; only the aspect differs.
    Scene scene = lit_sphere();
    Camera camera;
    RenderOptions options = options_of(40, 30, 4);
    const Image whole = render::render(scene, camera, options).image;
    options.cancelled = [calls = std::make_shared<std::atomic<int>>(0)] { return ++*calls > 2; };
    options.threads = 1;
    const RenderResult part = render::render(scene, camera, options);
    CHECK(part.cancelled);
    CHECK(part.samples == 2u * 16 * 16 * 4);
    int finished = 0;
    for (int y = 0; y < 30; ++y) {
        for (int x = 0; x < 40; ++x) {
            if (std::memcmp(part.image.at(x, y), whole.at(x, y), 3 * sizeof(float)) == 0) ++finished;
        }
    }
    CHECK(finished >= 2 * 16 * 16);
}

TEST_CASE("progress rises to one, from one thread at a time") {
    Scene scene = lit_sphere();
    RenderOptions options = options_of(64, 64, 1);
    std::vector<double> fractions;
    options.progress = [&](double fraction) { fractions.push_back(fraction); };
    CHECK_FALSE(render::render(scene, {}, options).cancelled);
    REQUIRE(fractions.size() == 16);
    CHECK(std::is_sorted(fractions.begin(), fractions.end()));
    CHECK(fractions.front() > 0.0);
    CHECK(fractions.back() == 1.0);
}

TEST_CASE("moved vertices give the picture of a scene made with them") {
    const Shape sphere = icosphere(3);
    Points moved = sphere.V;
    moved.col(0) *= 0.6;
    moved.array().col(2) += 0.3 * sphere.V.array().col(0).square();
    const auto scene_of = [&](const Points& V, const SceneOptions& options) {
        Scene scene(options);
        scene.add_mesh(V, sphere.F);
        scene.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 1.5f, Color::Constant(9.0f)));
        scene.sky.radiance.setConstant(0.2f);
        return scene;
    };
    const RenderOptions options = options_of(40, 30, 4);
    Scene fresh = scene_of(moved, {});
    const Image expected = render::render(fresh, {}, options).image;
    for (TreeUpdate update : {TreeUpdate::Build, TreeUpdate::Refit, TreeUpdate::Cheaper}) {
        SceneOptions how;
        how.moved = update;
        Scene scene = scene_of(sphere.V, how);
        CHECK_FALSE(same_bits(render::render(scene, {}, options).image, expected));
        scene.move_mesh(0, moved);
        CHECK(same_bits(render::render(scene, {}, options).image, expected));
        scene.move_mesh(0, sphere.V);
        scene.move_mesh(0, moved);
        CHECK(same_bits(render::render(scene, {}, options).image, expected));
        // Few and many rays per triangle in turns: the kind of tree changes.
        for (const int spp : {1, 64, 1}) {
            const RenderOptions other = options_of(40, 30, spp);
            scene.move_mesh(0, sphere.V);
            scene.move_mesh(0, moved);
            CHECK(same_bits(render::render(scene, {}, other).image, render::render(fresh, {}, other).image));
        }
    }
}

TEST_CASE("wrong input is refused with the place") {
    Scene scene;
    const Shape cube = box();
    Triangles F = cube.F;
    F(4, 1) = 8;
    CHECK_THROWS_AS(scene.add_mesh(cube.V, F), InvalidMesh);
    F(4, 1) = -1;
    CHECK_THROWS_AS(scene.add_mesh(cube.V, F), InvalidMesh);
    MeshOptions normals;
    normals.vertex_normals = Points::Ones(7, 3);
    CHECK_THROWS_AS(scene.add_mesh(cube.V, cube.F, normals), InvalidMesh);
    CHECK(scene.mesh_count() == 0);
    scene.add_mesh(cube.V, cube.F);
    CHECK_THROWS_AS(scene.move_mesh(0, Points::Zero(7, 3)), InvalidMesh);

    RenderOptions options = options_of(8, 8, 1);
    SECTION("no samples") {
        options.spp = 0;
    }
    SECTION("no size") {
        options.height = 0;
    }
    SECTION("negative path length") {
        options.max_scatter = -1;
    }
    SECTION("negative threads") {
        options.threads = -2;
    }
    SECTION("no tile") {
        options.tile = 0;
    }
    CHECK_THROWS_AS(render::render(scene, {}, options), ConfigError);
}

TEST_CASE("a pinned instruction set renders the same picture up to rounding") {
    SceneOptions pinned;
    pinned.embree_config = "isa=sse4.2";
    Scene a = lit_sphere(pinned), b = lit_sphere();
    const RenderOptions options = options_of(40, 30, 16);
    const Image x = render::render(a, {}, options).image, y = render::render(b, {}, options).image;
    std::size_t different = 0;
    for (std::size_t i = 0; i < x.pixels.size(); ++i) {
        if (std::abs(x.pixels[i] - y.pixels[i]) > 1e-5f) ++different;
    }
    CHECK(different < x.pixels.size() / 100);
}
