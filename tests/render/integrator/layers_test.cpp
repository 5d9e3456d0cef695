// What a picture holds beside radiance, and how samples are spent: layers, adaptive sampling, lens and
// motion.
#include <algorithm>
#include <cmath>
#include <vector>

#include "morph/mesh/errors.h"
#include "render/integrator/render.h"
#include "tests/catch.h"
#include "tests/render/picture_mean.h"
#include "tests/render/sampling.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

namespace {

Scene colored_sphere() {
    const Shape sphere = icosphere(3), plane = square(5.0, -1.0);
    Scene scene;
    MeshOptions body;
    body.material.base_color = {0.8f, 0.4f, 0.2f};
    scene.add_mesh(plane.V, plane.F);
    scene.add_mesh(sphere.V, sphere.F, body);
    scene.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 1.5f, Color::Constant(9.0f)));
    scene.sky.radiance.setConstant(0.2f);
    return scene;
}

}  // namespace

TEST_CASE("layers say what is seen in the middle of the picture and beside it") {
    Scene scene = colored_sphere();
    Camera camera;
    camera.position = {0.0, -5.0, 0.0};
    RenderOptions options = small_picture(65, 16);
    options.layers = true;
    const RenderResult result = render::render(scene, camera, options);
    const Layers& layers = result.layers.value();
    CHECK(*layers.depth.at(32, 32) == Approx(4.0).margin(0.01));
    CHECK(*layers.object.at(32, 32) == 1.0f);
    CHECK(layers.position.at(32, 32)[1] == Approx(-1.0).margin(0.01));
    CHECK(layers.albedo.at(32, 32)[1] == Approx(0.4));
    CHECK(layers.shading_normal.at(32, 32)[1] == Approx(-1.0).margin(0.01));
    CHECK(layers.geometric_normal.at(32, 32)[1] == Approx(-1.0).margin(0.02));
    CHECK(*layers.samples.at(32, 32) == 16.0f);
    CHECK(*layers.object.at(32, 62) == 0.0f);  // the ground
    CHECK(layers.position.at(32, 62)[2] == Approx(-1.0));
    CHECK(*layers.object.at(2, 2) == -1.0f);  // nothing
    CHECK(*layers.face.at(2, 2) == -1.0f);
    CHECK(std::isinf(*layers.depth.at(2, 2)));
    CHECK(layers.albedo.at(2, 2)[0] == 0.0f);
    CHECK(layers.variance.at(2, 2)[0] == 0.0f);
    // The number of the triangle is that of one which holds the position.
    const Shape sphere = icosphere(3);
    const auto face = static_cast<int>(*layers.face.at(32, 32));
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) middle += sphere.V.row(sphere.F(face, k)).transpose() / 3.0;
    CHECK((middle - Eigen::Vector3d(0, -1, 0)).norm() < 0.15);
}

TEST_CASE("layers do not change the picture, nor do threads change the layers") {
    RenderOptions options = small_picture(33, 8);
    Scene scene = colored_sphere();
    const Image plain = render::render(scene, {}, options).image;
    options.layers = true;
    options.threads = 1;
    const RenderResult one = render::render(scene, {}, options);
    options.threads = 3;
    options.tile = 5;
    const RenderResult three = render::render(scene, {}, options);
    CHECK(same_bits(one.image, plain));
    CHECK(same_bits(three.image, plain));
    CHECK(same_bits(one.layers->variance, three.layers->variance));
    CHECK(same_bits(one.layers->shading_normal, three.layers->shading_normal));
    CHECK(same_bits(one.layers->face, three.layers->face));
}

TEST_CASE("the variance is not below that between pictures of different seeds, nor far above") {
    Scene scene = colored_sphere();
    RenderOptions options = small_picture(16, 4);
    options.layers = true;
    std::vector<double> mean(16 * 16 * 3), squares(16 * 16 * 3);
    double stated = 0.0;
    constexpr int kSeeds = 60;
    for (int seed = 0; seed < kSeeds; ++seed) {
        options.seed = static_cast<std::uint64_t>(seed);
        const RenderResult result = render::render(scene, {}, options);
        for (std::size_t i = 0; i < mean.size(); ++i) {
            const auto x = static_cast<double>(result.image.pixels[i]);
            mean[i] += x / kSeeds;
            squares[i] += x * x / kSeeds;
            stated += static_cast<double>(result.layers->variance.pixels[i]) / kSeeds;
        }
    }
    double found = 0.0;
    for (std::size_t i = 0; i < mean.size(); ++i)
        found += (squares[i] - mean[i] * mean[i]) * kSeeds / (kSeeds - 1);
    INFO("stated " << stated << ", found " << found);
    CHECK(stated > 0.95 * found);  // stratified samples do better than the independent ones it speaks of
    CHECK(stated < 6.0 * found);
}

TEST_CASE("adaptive sampling spends samples where the noise is, alike for any threads, without bias") {
    Scene scene = colored_sphere();
    RenderOptions options = small_picture(48, 512);
    const Image all = render::render(scene, {}, options).image;
    options.adaptive_error = 0.04;
    options.layers = true;
    options.threads = 1;
    const RenderResult adaptive = render::render(scene, {}, options);
    options.threads = 3;
    options.tile = 7;
    const RenderResult again = render::render(scene, {}, options);
    CHECK(same_bits(adaptive.image, again.image));
    CHECK(adaptive.samples == again.samples);
    CHECK(adaptive.samples < 48u * 48u * 512u / 3u);
    const Image& counts = adaptive.layers->samples;
    CHECK(*std::min_element(counts.pixels.begin(), counts.pixels.end()) == 16.0f);
    CHECK(*std::max_element(counts.pixels.begin(), counts.pixels.end()) >= 128.0f);
    double bias = 0.0, error = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < all.pixels.size(); ++i) {
        const double d = static_cast<double>(adaptive.image.pixels[i] - all.pixels[i]);
        bias += d;
        error += d * d / static_cast<double>((all.pixels[i] + 0.01f) * (all.pixels[i] + 0.01f));
        sum += static_cast<double>(all.pixels[i]);
    }
    CHECK(std::abs(bias) < 0.001 * sum);
    CHECK(std::sqrt(error / static_cast<double>(all.pixels.size())) < 0.02);

    options.pilot = 1;
    CHECK_THROWS_AS(render::render(scene, {}, options), ConfigError);
    options.pilot = 16;
    options.adaptive_error = -1.0;
    CHECK_THROWS_AS(render::render(scene, {}, options), ConfigError);
}

TEST_CASE("rays of a lens start evenly over its disk and meet where the picture is sharp") {
    Camera camera;
    camera.position = {1.0, 2.0, 3.0};
    camera.target = {1.0, 7.0, 3.0};
    camera.lens_radius = 0.25;
    camera.focus_distance = 4.0;
    const PictureCamera view(camera, 40, 30);
    CHECK(view.has_lens());
    constexpr int kSamples = 40000, kRings = 8, kSectors = 8;
    Numbers numbers(4);
    EvenCells cells(kRings, kSectors);
    for (int i = 0; i < kSamples; ++i) {
        const float u = numbers(), v = numbers();
        const Ray ray = view.lens_ray(31.0f, 7.0f, u, v);
        const Vec3 start = ray.origin - view.origin();
        REQUIRE(std::abs(start.y()) < 1e-5f);
        cells.add(static_cast<double>(start.squaredNorm()) / 0.0625, start.x(), start.z());
        const float t = (6.0f - ray.origin.y()) / ray.direction.y();  // the plane y = 2 + 4
        const Eigen::Vector2d pixel = view.project((ray.origin + t * ray.direction).cast<double>()).value();
        REQUIRE(pixel.x() == Approx(31.0).margin(1e-3));
        REQUIRE(pixel.y() == Approx(7.0).margin(1e-3));
    }
    CHECK(std::abs(cells.deviation()) < 4.0);

    camera.lens_radius = -0.1;
    CHECK_THROWS_AS(PictureCamera(camera, 40, 30), ConfigError);
}

TEST_CASE("what is out of focus is spread over the circle of confusion, the light is kept") {
    const Shape plate = square(0.02, 0.0);
    Points V = plate.V;
    V.col(2) = plate.V.col(1);
    V.col(1).setZero();
    MeshOptions glow;
    glow.material.base_color.setZero();
    glow.material.emission.setOnes();
    const auto picture = [&](double radius, double focus) {
        Scene scene;
        scene.add_mesh(V, plate.F, glow);
        Camera camera;
        camera.position = {0.0, -2.0, 0.0};
        camera.vertical_fov = 20.0;
        camera.lens_radius = radius;
        camera.focus_distance = focus;
        return render::render(scene, camera, small_picture(64, 256)).image;
    };
    const Image sharp = picture(0.0, 0.0), focused = picture(0.1, 2.0), blurred = picture(0.1, 4.0);
    const auto lit = [](const Image& image) {
        return std::count_if(image.pixels.begin(), image.pixels.end(), [](float x) { return x > 0.0f; }) / 3;
    };
    CHECK(std::abs(lit(focused) - lit(sharp)) <= 4);
    CHECK(lit(blurred) > 8 * lit(sharp));
    // Half the picture is 2 tan 10 degrees wide. The plate of side 0.04 grows by the circle's radius, half
    // the lens's.
    const double pixels = 32.0 / (2.0 * std::tan(10.0 / 57.29577951308232)), r = 0.05;
    const double area = 0.04 * 0.04 + 4 * 0.04 * r + 3.14159265 * r * r;
    CHECK(static_cast<double>(lit(blurred)) == Approx(area * pixels * pixels).epsilon(0.12));
    CHECK(mean_red(focused).value == Approx(mean_red(sharp).value).epsilon(0.02));
    CHECK(mean_red(blurred).value == Approx(mean_red(sharp).value).epsilon(0.02));
}

TEST_CASE("a moving mesh is the mean of its moments") {
    const Shape sphere = icosphere(2);
    const auto at = [&](double t) {
        // Two straight parts: right, then up, and flatter.
        Points V = 0.5 * sphere.V;
        V.col(0).array() += t < 0.5 ? 2.0 * t : 1.0;
        V.col(2).array() += t < 0.5 ? 0.0 : 2.0 * t - 1.0;
        return V;
    };
    for (Normals normals : {Normals::Flat, Normals::Smooth}) {
        Scene moving, still;
        MeshOptions options;
        options.normals = normals;
        still.add_mesh(at(0), sphere.F, options);
        options.time_steps = 3;
        moving.add_mesh(at(0), sphere.F, options);
        moving.move_mesh(0, {at(0), at(0.5), at(1)});
        for (Scene* scene : {&moving, &still}) {
            scene->lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 1.5f, Color::Constant(9.0f)));
            scene->sky.radiance.setConstant(0.2f);
            scene->background = Color::Zero();
        }
        const Image blurred = render::render(moving, {}, small_picture(24, 1024)).image;
        std::vector<double> mean(blurred.pixels.size(), 0.0);
        constexpr int kMoments = 64;
        for (int k = 0; k < kMoments; ++k) {
            still.move_mesh(0, at((k + 0.5) / kMoments));
            RenderOptions picture = small_picture(24, 16);
            picture.seed = static_cast<std::uint64_t>(k);
            const Image image = render::render(still, {}, picture).image;
            for (std::size_t i = 0; i < mean.size(); ++i)
                mean[i] += static_cast<double>(image.pixels[i]) / kMoments;
        }
        double worst = 0.0, total = 0.0, difference = 0.0;
        for (std::size_t i = 0; i < mean.size(); ++i) {
            const double d = static_cast<double>(blurred.pixels[i]) - mean[i];
            worst = std::max(worst, std::abs(d));
            difference += d;
            total += mean[i];
        }
        CHECK(worst < 0.08);
        CHECK(std::abs(difference) < 0.003 * total);
        CHECK_FALSE(still.has_motion());
        CHECK(moving.has_motion());
        CHECK_THROWS_AS(moving.move_mesh(0, std::vector<Points>{at(0), at(1)}), InvalidMesh);
        CHECK_THROWS_AS(moving.move_mesh(0, {at(0), at(0.5), Points::Zero(7, 3)}), InvalidMesh);
        // At rest again.
        moving.move_mesh(0, at(0.25));
        still.move_mesh(0, at(0.25));
        RenderOptions picture = small_picture(24, 64);
        const double a = mean_red(render::render(moving, {}, picture).image).value;
        CHECK(a == Approx(mean_red(render::render(still, {}, picture).image).value).epsilon(0.002));
    }
}
