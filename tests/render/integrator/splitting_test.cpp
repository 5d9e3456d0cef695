// Several paths from the first surface: the same mean for less noise per ray, the same bits however it is
// computed.
#include <cmath>

#include "render/integrator/render.h"
#include "render/integrator/sample_numbers.h"
#include "tests/catch.h"
#include "tests/render/picture_mean.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

namespace {

/// Rough metal that throws the light of a lamp on the ground, or a diffuse body.
Scene body_on_ground(bool metal) {
    const Shape body = icosphere(3), plane = square(5.0, -1.0);
    Scene scene;
    MeshOptions options, ground;
    options.normals = ground.normals = Normals::Flat;
    options.material.metallic = metal ? 1.0f : 0.0f;
    options.material.roughness = 0.4f;
    scene.add_mesh(body.V, body.F, options);
    scene.add_mesh(plane.V, plane.F, ground);
    scene.lights.push_back(square_light({2, -2, 3}, {0, 0, 0}, 0.5f, Color(36.0f, 32.0f, 28.0f)));
    scene.sky.radiance.setConstant(0.02f);
    return scene;
}

RenderOptions picture(bool split, std::uint64_t seed) {
    RenderOptions options;
    options.width = 64;
    options.height = 48;
    options.spp = 32;
    options.seed = seed;
    options.split = split;
    return options;
}

/// Of pictures of several seeds.
struct Pictures {
    double mean = 0.0, error = 0.0;  ///< of the pictures' mean radiance, and its standard error
    double noise = 0.0;              ///< variance of a pixel over its squared mean, averaged
    double rays = 0.0;               ///< of a picture
};

Pictures render_seeds(bool metal, bool split, std::uint64_t first_seed) {
    constexpr int kSeeds = 8;
    Scene scene = body_on_ground(metal);
    std::vector<Image> images;
    Pictures result;
    double squares = 0.0;
    for (std::uint64_t seed = first_seed; seed < first_seed + kSeeds; ++seed) {
        const RenderResult rendered = render::render(scene, {}, picture(split, seed));
        const double mean = mean_red(rendered.image).value;
        result.mean += mean / kSeeds;
        squares += mean * mean / kSeeds;
        result.rays += static_cast<double>(rendered.rays) / kSeeds;
        images.push_back(rendered.image);
    }
    result.error = std::sqrt(std::max(0.0, squares - result.mean * result.mean) / (kSeeds - 1));
    const std::size_t values = images.front().pixels.size();
    for (std::size_t i = 0; i < values; ++i) {
        double sum = 0.0, sum2 = 0.0;
        for (const Image& image : images) {
            sum += static_cast<double>(image.pixels[i]) / kSeeds;
            sum2 += static_cast<double>(image.pixels[i]) * static_cast<double>(image.pixels[i]) / kSeeds;
        }
        result.noise += (sum2 - sum * sum) / (sum * sum + 1e-4) / static_cast<double>(values);
    }
    return result;
}

}  // namespace

TEST_CASE("split paths have the same mean, and less noise for as many rays", "[sweep]") {
    const Pictures whole = render_seeds(true, false, 1), split = render_seeds(true, true, 101);
    INFO("means " << whole.mean << ' ' << split.mean << ", noise " << whole.noise << ' ' << split.noise
                  << ", rays " << whole.rays << ' ' << split.rays);
    CHECK(std::abs(split.mean - whole.mean) < 4.0 * std::hypot(split.error, whole.error));
    CHECK(split.mean == Approx(whole.mean).epsilon(0.003));
    CHECK(split.rays > 1.2 * whole.rays);
    CHECK(split.noise < 0.65 * whole.noise);
    CHECK(split.noise * split.rays < 0.95 * whole.noise * whole.rays);
}

TEST_CASE("split pictures have the same bits for any number of threads and any tile size") {
    RenderOptions options = picture(true, 3);
    options.width = 61;
    options.threads = 1;
    Scene scene = body_on_ground(true);
    const RenderResult expected = render::render(scene, {}, options);
    options.split = false;
    CHECK(render::render(scene, {}, options).rays < expected.rays);
    options.split = true;
    for (const int threads : {2, 5}) {
        options.threads = threads;
        options.tile = 3 * threads;
        const RenderResult result = render::render(scene, {}, options);
        CHECK(same_bits(result.image, expected.image));
        CHECK(result.rays == expected.rays);
    }
}

TEST_CASE("few samples are not split") {
    RenderOptions options = picture(true, 3);
    options.spp = 16;
    Scene scene = body_on_ground(true);
    const Image image = render::render(scene, {}, options).image;
    options.split = false;
    CHECK(same_bits(render::render(scene, {}, options).image, image));
}

TEST_CASE("prepared numbers of split paths are those that are computed one by one") {
    const PixelSampler pixel(5, 1, 20, 30);
    constexpr std::uint32_t kFirst = 48, kBranches = 3, kBatch = PixelSampler::kBatch;
    SampleNumbers::Prepared prepared, none;
    prepared.branches = kBranches;
    for (std::uint32_t i = 0; i < kBranches; ++i) {
        pixel(kFirst * kBranches + i * kBatch, kScatter, prepared.scatter[i]);
        pixel(kFirst * kBranches + i * kBatch, kChoice, prepared.choice[i]);
    }
    for (std::size_t sample = 0; sample < kBatch; ++sample) {
        const SampleNumbers a(pixel, prepared, 0, kFirst, sample), b(pixel, none, 0, kFirst, sample);
        for (std::uint32_t which = 0; which < kBranches; ++which) {
            for (const Pair pair : {kScatter, kChoice, kLight}) {
                const Sample2 x = a.branch(pair, which, kBranches), y = b.branch(pair, which, kBranches);
                const auto index = (kFirst + static_cast<std::uint32_t>(sample)) * kBranches + which;
                CHECK((x.u == y.u && x.v == y.v));
                CHECK(x.u == pixel(index, pair).u);
            }
        }
    }
}
