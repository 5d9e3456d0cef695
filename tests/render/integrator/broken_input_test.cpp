// Input that no picture should be made of, and one is: without a pixel that is not finite, and with a count
// of the samples that were dropped.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "render/integrator/render.h"
#include "tests/catch.h"
#include "tests/render/picture_mean.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr float kNaNf = std::numeric_limits<float>::quiet_NaN();

RenderOptions small_options(int width, int height, int spp) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.spp = spp;
    return options;
}

MeshOptions made_of(const Material& material) {
    MeshOptions options;
    options.material = material;
    return options;
}

Scene ball_on_ground(const Material& material, const SceneOptions& options = {}) {
    const Shape sphere = icosphere(2), plane = square(5.0, -1.0);
    Scene scene(options);
    scene.add_mesh(sphere.V, sphere.F, made_of(material));
    scene.add_mesh(plane.V, plane.F, {});
    scene.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 1.5f, Color(9.0f, 8.0f, 7.0f)));
    scene.sky.radiance.setConstant(0.2f);
    return scene;
}

/// One of each kind of surface.
std::vector<Material> kinds() {
    std::vector<Material> result(5);
    result[1].metallic = 1.0f;
    result[2].specular = 1.0f;
    result[3].transmission = 1.0f;
    result[4].transmission = 1.0f;
    result[4].roughness = 0.0f;
    return result;
}

bool all_real(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(),
                       [](float x) { return std::isfinite(x) && x >= 0; });
}

}  // namespace

TEST_CASE("degenerate and broken geometry gives a finite picture") {
    const Shape sphere = icosphere(2);
    Points V = sphere.V;
    Triangles F = sphere.F;
    SECTION("vertices that are not finite") {
        V.row(3).setConstant(kNaN);
        V(17, 1) = std::numeric_limits<double>::infinity();
        V(30, 0) = 1e300;
    }
    SECTION("all vertices are not numbers") {
        V.setConstant(kNaN);
    }
    SECTION("all vertices coincide") {
        V.setConstant(0.25);
    }
    SECTION("all vertices on a line") {
        V.col(1) = V.col(0);
        V.col(2) = V.col(0);
    }
    SECTION("triangles with a repeated vertex") {
        F.col(1).topRows(100) = F.col(0).topRows(100);
    }
    SECTION("every triangle twice, once turned over") {
        Triangles twice(2 * F.rows(), 3);
        twice << F, F.rowwise().reverse();
        F = twice;
    }
    SECTION("no triangles") {
        F.resize(0, 3);
    }
    SECTION("nothing at all") {
        V.resize(0, 3);
        F.resize(0, 3);
    }
    for (Normals normals : {Normals::Flat, Normals::Smooth}) {
        Scene scene;
        MeshOptions mesh;
        mesh.normals = normals;
        scene.add_mesh(V, F, mesh);
        const Shape plane = square(5.0, -0.5);
        scene.add_mesh(plane.V, plane.F, mesh);
        scene.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 1.5f, Color::Ones()));
        scene.sky.radiance.setConstant(0.2f);
        const RenderResult result = render::render(scene, {}, small_options(32, 24, 4));
        CHECK(all_real(result.image));
        CHECK(result.bad_samples == 0);
        scene.move_mesh(0, V);
        CHECK(all_real(render::render(scene, {}, small_options(32, 24, 4)).image));
    }
}

TEST_CASE("an empty scene shows its background, a camera inside a closed body sees black") {
    Scene empty;
    empty.sky.radiance.setConstant(0.25f);
    const Image sky = render::render(empty, {}, small_options(8, 8, 2)).image;
    CHECK(std::count(sky.pixels.begin(), sky.pixels.end(), 0.25f) == 8 * 8 * 3);
    empty.background = Color::Constant(0.5f);
    const Image background = render::render(empty, {}, small_options(8, 8, 2)).image;
    CHECK(std::count(background.pixels.begin(), background.pixels.end(), 0.5f) == 8 * 8 * 3);

    const Shape cube = box();
    Scene closed;
    closed.add_mesh(cube.V, cube.F);
    closed.sky.radiance.setOnes();
    closed.lights.push_back(square_light({0, 0, 3}, {0, 0, 0}, 1.0f, Color::Constant(5.0f)));
    Camera inside;
    inside.position = {0.2, 0.1, 0.0};
    inside.target = {1.0, 0.3, 0.4};
    const RenderResult result = render::render(closed, inside, small_options(16, 16, 16));
    CHECK(std::count(result.image.pixels.begin(), result.image.pixels.end(), 0.0f) == 16 * 16 * 3);
}

TEST_CASE("faces of two meshes in one place give the picture of either, whatever they are made of") {
    const Shape sphere = icosphere(2);
    for (const Material& material : kinds()) {
        Scene twice = ball_on_ground(material);
        twice.add_mesh(sphere.V, sphere.F, made_of(material));
        const RenderResult result = render::render(twice, {}, small_options(32, 24, 16));
        CHECK(all_real(result.image));
        CHECK(result.bad_samples == 0);
        if (material.transmission > 0.0f) continue;  // two boundaries in one place are no glass
        Scene once = ball_on_ground(material);
        const Image expected = render::render(once, {}, small_options(32, 24, 16)).image;
        CHECK(mean_red(result.image).value == Approx(mean_red(expected).value).epsilon(0.02));
    }
}

TEST_CASE("without any light all is black; lights without size or power add nothing") {
    for (const Material& material : kinds()) {
        Scene dark = ball_on_ground(material);
        dark.lights.clear();
        dark.sky.radiance.setZero();
        const RenderResult night = render::render(dark, {}, small_options(16, 12, 8));
        CHECK(std::count(night.image.pixels.begin(), night.image.pixels.end(), 0.0f) == 16 * 12 * 3);
        CHECK(night.bad_samples == 0);

        dark.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 0.0f, Color::Ones()));
        dark.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 1.0f, Color::Zero()));
        dark.sphere_lights.push_back({{2, -2, 3}, 0.0f, Color::Ones(), true});
        dark.sphere_lights.push_back({{-2, -2, 3}, 1.0f, Color::Zero(), false});
        dark.sky.map = std::make_shared<EquirectangularMap>(Image(8, 4, 3, 0.0f));
        const RenderResult result = render::render(dark, {}, small_options(16, 12, 8));
        CHECK(std::count(result.image.pixels.begin(), result.image.pixels.end(), 0.0f) == 16 * 12 * 3);
        CHECK(result.bad_samples == 0);
    }
}

TEST_CASE("a camera inside a body, on its surface or inside a light sees something finite") {
    for (const Material& material : kinds()) {
        for (const Eigen::Vector3d& position :
             {Eigen::Vector3d(0.1, 0.2, 0.05), Eigen::Vector3d(0.0, -1.0, 0.0),
              Eigen::Vector3d(0.0, 0.0, -1.0)}) {
            Scene scene = ball_on_ground(material);
            scene.sphere_lights.push_back({{0.1f, 0.2f, 0.0f}, 0.3f, Color::Constant(2.0f), true});
            Camera camera;
            camera.position = position;
            camera.target = {2.0, 0.5, 0.3};
            const RenderResult result = render::render(scene, camera, small_options(24, 24, 16));
            CHECK(all_real(result.image));
            CHECK(result.bad_samples == 0);
        }
    }
}

TEST_CASE("samples that are not finite are dropped and counted") {
    Scene scene = ball_on_ground({});
    Material broken;
    broken.base_color = {0.5f, std::numeric_limits<float>::quiet_NaN(), 0.5f};
    scene.set_material(0, broken);
    const RenderResult result = render::render(scene, {}, small_options(32, 24, 4));
    CHECK(result.bad_samples > 100);
    CHECK(result.bad_samples < result.samples);
    CHECK(all_real(result.image));
}

TEST_CASE("rays that are not finite or out of bounds are dropped and counted, not traced") {
    for (const char* config : {"", "isa=sse4.2"}) {  // without AVX-512 packets are split
        Scene scene = ball_on_ground({}, {.embree_config = config});
        Camera camera;
        camera.position = {0.0, -1e30, 0.0};
        const RenderResult far = render::render(scene, camera, small_options(8, 8, 4));
        CHECK(all_real(far.image));
        CHECK(far.bad_samples == far.samples);
        camera = {};
        camera.lens_radius = 1e30;
        const RenderResult wide = render::render(scene, camera, small_options(8, 8, 4));
        CHECK(all_real(wide.image));
        CHECK(wide.bad_samples == wide.samples);
    }
}

TEST_CASE("vertex normals and colours that are not numbers reach no pixel, and are counted") {
    const Shape sphere = icosphere(2);
    for (const Material& material : kinds()) {
        Scene scene = ball_on_ground(material);
        MeshOptions options = made_of(material);
        options.vertex_normals = sphere.V;
        options.vertex_normals.topRows(20).setConstant(kNaN);
        options.vertex_normals.row(30).setZero();
        Points moved = sphere.V;
        moved.col(0).array() += 1.5;
        scene.add_mesh(moved, sphere.F, options);
        const RenderResult rough = render::render(scene, {}, small_options(48, 32, 8));
        CHECK(all_real(rough.image));
        CHECK(rough.bad_samples == 0);  // such vertices have no normal

        INFO("metal " << material.metallic << ", glass " << material.transmission << ", coat "
                      << material.specular);
        scene.color_mesh(0, Points::Constant(sphere.V.rows(), 3, kNaN));
        const RenderResult result = render::render(scene, {}, small_options(48, 32, 8));
        CHECK(all_real(result.image));
        CHECK(result.bad_samples > 0);
        CHECK(result.bad_samples < result.samples);
    }
}

TEST_CASE("lights and skies that are not numbers reach no pixel, and are counted") {
    for (const Material& material : kinds()) {
        Scene scene = ball_on_ground(material);
        SECTION("the radiance of a light") {
            scene.lights.front().radiance[1] = kNaNf;
        }
        SECTION("an infinite radiance") {
            scene.lights.front().radiance.setConstant(std::numeric_limits<float>::infinity());
        }
        SECTION("the place of a light") {
            scene.lights.front().center[0] = kNaNf;
        }
        SECTION("a sphere") {
            scene.sphere_lights.push_back({{kNaNf, 0.0f, 3.0f}, 0.5f, Color::Ones(), true});
        }
        SECTION("the sky") {
            scene.sky.radiance[2] = kNaNf;
        }
        const RenderResult result = render::render(scene, {}, small_options(24, 18, 8));
        CHECK(all_real(result.image));
        CHECK(result.bad_samples <= result.samples);
    }
    Scene scene = ball_on_ground({});
    scene.sky.radiance[2] = kNaNf;
    CHECK(render::render(scene, {}, small_options(24, 18, 8)).bad_samples > 0);
}
