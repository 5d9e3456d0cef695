// Materials in whole pictures: furnaces, and strategies that must agree.
#include <cmath>
#include <memory>

#include "morph/mesh/errors.h"
#include "render/integrator/render.h"
#include "tests/catch.h"
#include "tests/render/picture_mean.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

namespace {

Material metal(float alpha) {
    Material m;
    m.base_color = m.edge_color = Color::Ones();
    m.metallic = 1.0f;
    m.roughness = std::sqrt(alpha);
    return m;
}

Material glass(float roughness) {
    Material m;
    m.base_color.setOnes();
    m.transmission = 1.0f;
    m.roughness = roughness;
    return m;
}

Material plastic(float roughness) {
    Material m;
    m.base_color.setConstant(0.6f);
    m.specular = 1.0f;
    m.roughness = roughness;
    return m;
}

// Looks at the origin of the plane z = 0 under an angle from the normal, so closely that nothing varies.
Camera under_angle(double degrees) {
    const double a = degrees * 3.14159265358979 / 180.0;
    Camera camera;
    camera.position = {0.0, -std::sin(a), std::cos(a)};
    camera.target.setZero();
    camera.up = {0.0, 1.0, 1.0};
    camera.vertical_fov = 1e-3;
    return camera;
}

}  // namespace

TEST_CASE("a metal plane in a sky of radiance one has the known reflectance") {
    for (const auto& [degrees, share] :
         {std::pair{0.0, 0.94766}, std::pair{60.0, 0.89411}, std::pair{80.0, 0.84788}}) {
        Scene scene;
        const Shape plane = square(100.0, 0.0);
        MeshOptions options;
        options.material = metal(0.2f);
        scene.add_mesh(plane.V, plane.F, options);
        scene.sky.radiance.setOnes();
        const Mean mean = mean_red(render::render(scene, under_angle(degrees), small_picture(16, 256)).image);
        CHECK(std::abs(mean.value - share) < 3.0 * mean.error + 3e-4);
        CHECK(mean.error < 1e-3);
    }
}

TEST_CASE("glass in a sky of radiance one cannot be seen") {
    const Shape sphere = icosphere(3);
    for (float roughness : {0.0f, 0.3f}) {
        for (Normals normals : {Normals::Flat, Normals::Smooth}) {
            Scene scene;
            MeshOptions options;
            options.normals = normals;
            options.material = glass(roughness);
            scene.add_mesh(sphere.V, sphere.F, options);
            scene.sky.radiance.setOnes();
            Camera camera;
            camera.vertical_fov = 20.0;
            RenderOptions picture = small_picture(24, 64);
            picture.max_scatter = 1000;
            const RenderResult result = render::render(scene, camera, picture);
            CHECK(result.bad_samples == 0);
            const Mean mean = mean_red(result.image);
            INFO("roughness " << roughness << ", mean " << mean.value << " +- " << mean.error);
            // Single scattering loses what hits a second facet; interpolated normals lose at the rim.
            CHECK(mean.value < 1.0 + 3.0 * mean.error + 1e-4);
            CHECK(mean.value > (roughness > 0.0f || normals == Normals::Smooth ? 0.95 : 0.998));
        }
    }
}

TEST_CASE("the background and the shadow alone are seen through glass") {
    const Shape sphere = icosphere(3), plane = square(40.0, -1.01);
    for (float roughness : {0.0f, 0.3f}) {
        Scene scene;
        MeshOptions body;
        body.material = glass(roughness);
        // Smooth glass of index 1 bends nothing and reflects nothing; rough glass needs some other index.
        body.material.ior = roughness > 0.0f ? 1.1f : 1.0f;
        scene.add_mesh(sphere.V, sphere.F, body);
        scene.sky.radiance.setConstant(0.2f);
        scene.background = Color(0.9f, 0.8f, 0.7f);
        Camera camera;
        camera.vertical_fov = 10.0;
        const Image image = render::render(scene, camera, small_picture(8, 64)).image;
        const double tolerance = roughness > 0.0f ? 0.06 : 1e-5;
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const float expected = (*scene.background)[static_cast<Eigen::Index>(i % 3)];
            CHECK(image.pixels[i] == Approx(expected).epsilon(tolerance));
        }
    }
    // A catcher that nothing shadows has the background's radiance behind a pane of glass, too.
    Scene scene;
    MeshOptions pane, ground;
    pane.material = glass(0.0f);
    pane.material.ior = 1.0f;
    const Shape window =
        make_shape({{-9, -5, -9}, {9, -5, -9}, {9, -5, 9}, {-9, -5, 9}}, {{0, 1, 2}, {0, 2, 3}});
    scene.add_mesh(window.V, window.F, pane);
    ground.material.shadow_catcher = true;
    scene.add_mesh(plane.V, plane.F, ground);
    scene.sky.radiance.setConstant(0.2f);
    scene.background = Color::Constant(0.9f);
    Camera camera;
    camera.position = {0.0, -10.0, 2.0};
    camera.target = {0.0, 0.0, -1.0};
    camera.vertical_fov = 10.0;
    const Mean mean = mean_red(render::render(scene, camera, small_picture(16, 64)).image);
    // The pane is in the sky's way, but lets everything through.
    CHECK(mean.value == Approx(0.9).epsilon(0.01));
}

TEST_CASE("strategies agree on every material, under rectangle, sphere and map", "[sweep]") {
    const Shape sphere = icosphere(2), plane = square(5.0, -1.0);
    Image sky(16, 8, 3, 0.1f);
    for (int c = 0; c < 3; ++c) sky.at(5, 2)[c] = sky.at(6, 2)[c] = 20.0f;
    const auto map = std::make_shared<EquirectangularMap>(sky);
    Camera camera;
    camera.position = {0.0, -6.0, 2.0};
    for (const Material& material : {metal(0.2f), plastic(0.5f), glass(0.6f)}) {
        const auto mean = [&](LightStrategy strategy, std::uint64_t seed) {
            Scene scene;
            MeshOptions body, ground;
            body.material = material;
            scene.add_mesh(sphere.V, sphere.F, body);
            ground.material.base_color.setConstant(0.5f);
            scene.add_mesh(plane.V, plane.F, ground);
            scene.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 2.0f, Color::Constant(4.0f)));
            scene.sphere_lights.push_back({{-2.0f, -2.0f, 2.0f}, 0.7f, Color::Constant(6.0f), true});
            scene.sky.map = map;
            RenderOptions options = small_picture(16, 64);
            options.lights = strategy;
            double sum = 0.0, squares = 0.0;
            for (std::uint64_t k = 0; k < 8; ++k) {
                options.seed = 8 * seed + k;
                const double x = mean_red(render::render(scene, camera, options).image).value;
                sum += x / 8;
                squares += x * x / 8;
            }
            return Mean{sum, std::sqrt(std::max(0.0, squares - sum * sum) / 7)};
        };
        const Mean both = mean(LightStrategy::Both, 1);
        for (LightStrategy strategy : {LightStrategy::Lights, LightStrategy::Scatter}) {
            const Mean other = mean(strategy, strategy == LightStrategy::Lights ? 2 : 3);
            INFO(both.value << " +- " << both.error << " and " << other.value << " +- " << other.error);
            CHECK(std::abs(other.value - both.value) < 4.5 * std::hypot(other.error, both.error));
            CHECK(both.error < 0.02 * both.value);
        }
    }
}

TEST_CASE("a material out of range is refused when a picture is made") {
    Scene scene;
    const Shape cube = box();
    MeshOptions options;
    options.material.roughness = 2.0f;
    scene.add_mesh(cube.V, cube.F, options);
    CHECK_THROWS_AS(render::render(scene, {}, small_picture(4, 1)), ConfigError);
}
