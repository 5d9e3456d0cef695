#include "render/denoise/denoise.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "morph/mesh/errors.h"
#include "render/camera/framing.h"
#include "render/integrator/render.h"
#include "render/studio/studio.h"
#include "tests/catch.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

namespace {

constexpr int kSize = 96;

RenderResult studio_sphere(int spp, const Material& material) {
    const Shape sphere = icosphere(4);
    const Camera camera = frame_all({sphere.V}, {});
    Bounds bounds;
    bounds.add(sphere.V);
    Scene scene;
    MeshOptions options;
    options.material = material;
    scene.add_mesh(sphere.V, sphere.F, options);
    add_studio(scene, camera, bounds);
    RenderOptions settings;
    settings.width = settings.height = kSize;
    settings.spp = spp;
    settings.layers = true;
    return render::render(scene, camera, settings);
}

double relative_error(const Image& image, const Image& reference) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const double truth = static_cast<double>(reference.pixels[i]),
                     apart = static_cast<double>(image.pixels[i]) - truth;
        sum += apart * apart / (truth * truth + 0.01);
    }
    return sum / static_cast<double>(image.pixels.size());
}

}  // namespace

TEST_CASE("clay in the studio comes much nearer to the truth", "[sweep]") {
    const RenderResult noisy = studio_sphere(16, clay()), truth = studio_sphere(1024, clay());
    const double before = relative_error(noisy.image, truth.image);
    const double after = relative_error(denoise(noisy.image, *noisy.layers), truth.image);
    INFO(before << " before, " << after << " after");
    CHECK(after < before / 3);
}

TEST_CASE("a picture without noise stays as it is") {
    RenderResult truth = studio_sphere(64, clay());
    std::fill(truth.layers->variance.pixels.begin(), truth.layers->variance.pixels.end(), 0.0f);
    const Image same = denoise(truth.image, *truth.layers);
    double largest = 0;
    for (std::size_t i = 0; i < same.pixels.size(); ++i)
        largest = std::max(largest, std::abs(static_cast<double>(same.pixels[i] - truth.image.pixels[i])));
    CHECK(largest < 1e-3);
}

TEST_CASE("what differs in albedo or normal is not mixed, however noisy") {
    Image image(32, 32);
    Layers layers;
    layers.albedo = layers.shading_normal = layers.variance = Image(32, 32);
    layers.depth = Image(32, 32, 1, 1.0f);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool right = x >= 16, low = y >= 16;
            for (int c = 0; c < 3; ++c) {
                image.at(x, y)[c] = (right ? 0.8f : 0.2f) + (low ? 0.1f : 0.0f);
                layers.albedo.at(x, y)[c] = right ? 0.9f : 0.3f;
                layers.variance.at(x, y)[c] = 1.0f;
            }
            layers.shading_normal.at(x, y)[low ? 1 : 2] = 1.0f;
        }
    }
    const Image result = denoise(image, layers);
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        CHECK(result.pixels[i] == Approx(image.pixels[i]).epsilon(1e-5));
}

TEST_CASE("the bits do not depend on the number of threads") {
    const RenderResult noisy = studio_sphere(4, clay());
    const auto with = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        return denoise(noisy.image, *noisy.layers).pixels;
    };
    CHECK(with(1) == with(3));
}

TEST_CASE("layers of another size are refused") {
    RenderResult result = studio_sphere(1, clay());
    result.layers->variance = Image(3, 3);
    CHECK_THROWS_AS(denoise(result.image, *result.layers), Error);
}
