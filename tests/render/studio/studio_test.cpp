#include "render/studio/studio.h"

#include <cmath>
#include <limits>

#include "morph/mesh/errors.h"
#include "render/camera/framing.h"
#include "render/integrator/render.h"
#include "tests/catch.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

TEST_CASE("the studio shows any shape bright on an even background, whatever its size and place") {
    const Shape sphere = icosphere(3);
    Image first;
    for (double scale : {1.0, 1e-3, 250.0}) {
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
