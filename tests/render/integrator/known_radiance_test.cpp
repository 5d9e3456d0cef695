// Scenes whose radiance is known exactly.
#include <algorithm>
#include <cmath>
#include <memory>

#include "render/integrator/render.h"
#include "tests/catch.h"
#include "tests/render/day_sky.h"
#include "tests/render/picture_mean.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

namespace {

MeshOptions flat(float albedo) {
    MeshOptions options;
    options.normals = Normals::Flat;
    options.material.base_color.setConstant(albedo);
    return options;
}

// Looks at the origin's neighbourhood, so closely that the radiance does not vary.
Camera close_up() {
    Camera camera;
    camera.position = {0.0, -1.0, 0.8};
    camera.target.setZero();
    camera.vertical_fov = 1e-3;
    return camera;
}

}  // namespace

TEST_CASE("a plane under a square light has the closed form's radiance on the axis, by each strategy") {
    struct Case {
        float height, side;
        double radiance;
    };
    for (const Case& c : {Case{2.0f, 1.0f, 0.036739}, Case{1.0f, 2.0f, 0.277063}}) {
        for (LightStrategy strategy : {LightStrategy::Both, LightStrategy::Lights, LightStrategy::Scatter}) {
            Scene scene;
            const Shape plane = square(4.0, 0.0);
            scene.add_mesh(plane.V, plane.F, flat(0.5f));
            scene.lights.push_back(square_light({0, 0, c.height}, {0, 0, 0}, c.side, Color::Ones()));
            RenderOptions options = small_picture(16, 1024);
            options.lights = strategy;
            const Mean mean = mean_red(render::render(scene, close_up(), options).image);
            CHECK(std::abs(mean.value - c.radiance) < 3.0 * mean.error + 1e-6);
            CHECK(std::abs(mean.value - c.radiance) < 0.005 * c.radiance);
        }
    }
}

TEST_CASE("two lights add up, whatever their power") {
    Scene scene;
    const Shape plane = square(4.0, 0.0);
    scene.add_mesh(plane.V, plane.F, flat(0.5f));
    scene.lights.push_back(square_light({0, 0, 2}, {0, 0, 0}, 1.0f, Color::Constant(10.0f)));
    scene.lights.push_back(square_light({0, 0, 1}, {0, 0, 0}, 2.0f, Color::Ones()));
    scene.lights.push_back(square_light({0, 0, 1}, {0, 0, 0}, 2.0f, Color::Zero()));
    const Mean mean = mean_red(render::render(scene, close_up(), small_picture(16, 1024)).image);
    CHECK(std::abs(mean.value - 0.644453) < 3.0 * mean.error + 1e-6);
    CHECK(mean.value == Approx(0.644453).epsilon(0.005));
}

TEST_CASE("a convex body in a sky of radiance one has its albedo everywhere") {
    const Shape sphere = icosphere(3);
    Points ellipsoid = sphere.V;
    ellipsoid.col(0) *= 3.0;
    ellipsoid.col(2) *= 0.3;
    const Shape cube = box();
    Camera camera;
    camera.vertical_fov = 40.0;
    for (const auto& [V, F] : {Shape{sphere.V, sphere.F}, Shape{ellipsoid, sphere.F}, cube}) {
        for (double scale : {1e-3, 1.0, 1e3}) {
            Scene scene;
            scene.add_mesh(scale * V, F, flat(0.8f));
            scene.sky.radiance.setOnes();
            scene.background = Color::Zero();
            Camera scaled = camera;
            scaled.position *= scale;
            RenderOptions options = small_picture(64, 16);
            const RenderResult result = render::render(scene, scaled, options);
            CHECK(result.bad_samples == 0);
            // Inside the silhouette no sample may differ: no ray meets the body again.
            int inside = 0, wrong = 0;
            for (float x : result.image.pixels) {
                if (x > 0.75f) ++inside;
                if (x > 0.8f + 1e-6f || (x > 0.75f && x < 0.8f - 1e-6f && x != 0.8f * 15.0f / 16.0f)) ++wrong;
            }
            CHECK(inside > 1000);
            CHECK(wrong < inside / 1000);
        }
    }
}

TEST_CASE("smooth normals keep the furnace white") {
    const Shape sphere = icosphere(3);
    Scene scene;
    MeshOptions options;
    options.material.base_color.setConstant(0.8f);
    scene.add_mesh(sphere.V, sphere.F, options);
    scene.sky.radiance.setOnes();
    Camera camera;
    camera.position = {0.0, -4.0, 1.0};
    camera.vertical_fov = 20.0;  // the sphere fills the picture
    const Mean mean = mean_red(render::render(scene, camera, small_picture(48, 64)).image);
    CHECK(mean.value == Approx(0.8).epsilon(0.002));
    CHECK(mean.value <= 0.8 + 1e-6);
}

TEST_CASE("a closed box of glowing grey walls has the geometric sum of its bounces") {
    const Shape cube = box();
    Camera camera;
    camera.position = {0.1, -0.3, 0.2};
    camera.target = {0.5, 1.0, 0.3};
    camera.vertical_fov = 60.0;
    MeshOptions glowing = flat(0.5f);
    glowing.material.emission.setOnes();
    Scene scene;
    scene.add_mesh(cube.V, cube.F, glowing);
    for (const auto& [length, radiance] :
         {std::pair{0, 1.0}, std::pair{1, 1.5}, std::pair{2, 1.75}, std::pair{6, 1.984375}}) {
        RenderOptions options = small_picture(32, 16);
        options.max_scatter = length;
        options.roulette_after = 100;  // then every path is the same sum
        const Image image = render::render(scene, camera, options).image;
        for (float x : image.pixels) CHECK(x == Approx(radiance).epsilon(1e-6));
        options.roulette_after = 0;
        options.spp = 256;
        const Mean mean = mean_red(render::render(scene, camera, options).image);
        CHECK(std::abs(mean.value - radiance) < 3.0 * mean.error + 1e-6);
        CHECK(mean.value == Approx(radiance).epsilon(0.005));
    }
}

TEST_CASE("an infinite plane in a sky is lit by half of it, its albedo per colour") {
    Scene scene;
    const Shape plane = square(1e4, 0.0);
    MeshOptions options = flat(1.0f);
    options.material.base_color = {0.2f, 0.6f, 1.0f};
    scene.add_mesh(plane.V, plane.F, options);
    scene.sky.radiance = {3.0f, 2.0f, 1.0f};
    const Image image = render::render(scene, close_up(), small_picture(4, 4)).image;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
        CHECK(image.pixels[i] == Approx(0.6f));
        CHECK(image.pixels[i + 1] == Approx(1.2f));
        CHECK(image.pixels[i + 2] == Approx(1.0f));
    }
}

TEST_CASE("a white plane under the sky of a clear day has its known radiance, in each colour") {
    Scene scene;
    const Shape plane = square(1e3, 0.0);
    scene.add_mesh(plane.V, plane.F, flat(1.0f));
    scene.sky.map = std::make_shared<EquirectangularMap>(day_sky());
    for (LightStrategy strategy : {LightStrategy::Both, LightStrategy::Lights}) {
        RenderOptions options = small_picture(16, 1024);
        options.lights = strategy;
        Image image = render::render(scene, close_up(), options).image;
        for (const double expected : kDaySkyPlane) {
            const Mean mean = mean_red(image);
            CHECK(std::abs(mean.value - expected) < 3.0 * mean.error + 1e-5);
            CHECK(std::abs(mean.value - expected) < 0.003 * expected);
            std::rotate(image.pixels.begin(), image.pixels.begin() + 1,
                        image.pixels.end());  // the next colour
        }
    }
}

TEST_CASE("strategies and roulette agree where light bounces between ground and body", "[sweep]") {
    const Shape sphere = icosphere(2), plane = square(5.0, -1.0);
    Camera camera;
    camera.position = {0.0, -6.0, 2.0};
    const auto mean = [&](LightStrategy strategy, int roulette_after, std::uint64_t seed) {
        Scene scene;
        scene.add_mesh(sphere.V, sphere.F, flat(0.7f));
        scene.add_mesh(plane.V, plane.F, flat(0.9f));
        scene.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 3.0f, Color::Constant(4.0f)));
        scene.sky.radiance.setConstant(0.1f);
        RenderOptions options = small_picture(24, 128);
        options.lights = strategy;
        options.roulette_after = roulette_after;
        options.seed = seed;
        // The picture's mean; its error comes from eight seeds, since pixels differ.
        double sum = 0.0, squares = 0.0;
        for (int k = 0; k < 8; ++k) {
            options.seed = 8 * seed + static_cast<std::uint64_t>(k);
            const double x = mean_red(render::render(scene, camera, options).image).value;
            sum += x / 8;
            squares += x * x / 8;
        }
        return Mean{sum, std::sqrt(std::max(0.0, squares - sum * sum) / 7)};
    };
    const Mean both = mean(LightStrategy::Both, 100, 1);
    for (const Mean& other : {mean(LightStrategy::Lights, 100, 2), mean(LightStrategy::Scatter, 100, 3),
                              mean(LightStrategy::Both, 0, 4)}) {
        CHECK(std::abs(other.value - both.value) < 4.5 * std::hypot(other.error, both.error));
        CHECK(other.value == Approx(both.value).epsilon(0.005));
    }
}

TEST_CASE("a shadow catcher has the background's radiance but for the shadow") {
    const Shape plane = square(30.0, 0.0), sphere = icosphere(3);
    Scene scene;
    MeshOptions ground = flat(0.4f);
    ground.material.shadow_catcher = true;
    scene.add_mesh(plane.V, plane.F, ground);
    scene.lights.push_back(square_light({3, -2, 4}, {0, 0, 0}, 2.0f, Color(9.0f, 8.0f, 7.0f)));
    scene.lights.back().visible_to_camera = false;
    scene.sky.radiance = {0.2f, 0.3f, 0.4f};
    scene.background = Color(0.9f, 0.8f, 0.7f);
    Camera camera;
    camera.position = {0.0, -8.0, 3.0};
    const RenderOptions options = small_picture(32, 64);
    const Image empty = render::render(scene, camera, options).image;
    for (std::size_t i = 0; i < empty.pixels.size(); ++i) {
        CHECK(empty.pixels[i] == Approx((*scene.background)[static_cast<Eigen::Index>(i % 3)]).epsilon(0.02));
    }
    Points lifted = 0.3 * sphere.V;
    lifted.col(2).array() += 0.3;
    scene.add_mesh(lifted, sphere.F, flat(0.0f));
    const Image shadowed = render::render(scene, camera, options).image;
    // A black sphere only takes light away; its shadow reaches left behind it.
    for (std::size_t i = 0; i < empty.pixels.size(); ++i) CHECK(shadowed.pixels[i] < 1.02f * empty.pixels[i]);
    const PictureCamera pinhole(camera, options.width, options.height);
    const Eigen::Vector2d p = pinhole.project({-0.45, 0.3, 0.0}).value();
    CHECK(shadowed.at(static_cast<int>(p.x()), static_cast<int>(p.y()))[0] < 0.6f);
}

TEST_CASE("a coarse sphere with smooth normals is lit like a sphere, without a black terminator") {
    const Shape coarse = icosphere(2);  // 320 triangles
    Scene scene;
    MeshOptions options;
    options.material.base_color.setOnes();
    scene.add_mesh(coarse.V, coarse.F, options);
    const Vec3 to_light = Vec3(1.0f, -0.2f, 0.3f).normalized();
    const float distance = 500.0f;
    scene.lights.push_back(
        square_light(distance * to_light, {0, 0, 0}, 1.0f, Color::Constant(kPi * distance * distance)));
    Camera camera;
    camera.position = {0.0, -50.0, 0.0};
    camera.vertical_fov = 2.4;
    RenderOptions picture = small_picture(96, 16);
    picture.max_scatter = 1;
    const Image image = render::render(scene, camera, picture).image;
    // On a sphere the radiance is the cosine to the light. Seen from afar, the picture is an orthographic
    // one.
    const double half = 50.0 * std::tan(0.5 * 2.4 * 3.14159265358979 / 180.0);
    int lit = 0, black = 0;
    double worst = 0.0;
    for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
            const double X = half * ((x + 0.5) / 48 - 1), Z = half * (1 - (y + 0.5) / 48);
            if (X * X + Z * Z > 0.8) continue;  // away from the polygonal silhouette
            const Eigen::Vector3d n(X, -std::sqrt(1 - X * X - Z * Z), Z);
            const double cosine = n.dot(to_light.cast<double>());
            if (cosine < 0.05) continue;
            ++lit;
            if (image.at(x, y)[0] == 0.0f) ++black;
            worst = std::max(worst, std::abs(image.at(x, y)[0] - cosine));
        }
    }
    CHECK(lit > 2000);
    CHECK(black == 0);
    CHECK(worst < 0.06);
}
