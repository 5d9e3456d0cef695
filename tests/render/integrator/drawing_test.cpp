// What explains a mesh: colours of vertices, scalar fields, drawn edges.
#include <cmath>
#include <limits>

#include "morph/mesh/errors.h"
#include "render/film/color_map.h"
#include "render/integrator/render.h"
#include "tests/catch.h"
#include "tests/render/picture_mean.h"
#include "tests/render/shapes.h"

using namespace automorph;
using namespace automorph::render;

namespace {

// Looks down on the square of half side 1, which fills the picture; radiance is the albedo.
Camera from_above(double height, double slant = 0.0) {
    Camera camera;
    camera.position = {0.0, -slant, height};
    camera.target.setZero();
    camera.up = {0.0, 1.0, 0.0};
    camera.vertical_fov = 2.0 * std::atan(1.0 / std::hypot(height, slant)) * 57.29577951308232;
    return camera;
}

}  // namespace

TEST_CASE("vertex colours are interpolated over the triangles") {
    const Shape plane = square(1.0, 0.0);
    Scene scene;
    MeshOptions options;
    options.vertex_colors = Points(4, 3);
    for (int i = 0; i < 4; ++i) {  // red grows with x, green with y
        options.vertex_colors.row(i) << 0.5 + 0.4 * plane.V(i, 0), 0.5 + 0.4 * plane.V(i, 1), 0.25;
    }
    scene.add_mesh(plane.V, plane.F, options);
    scene.sky.radiance.setOnes();
    const Image image = render::render(scene, from_above(2.0), small_picture(20, 64)).image;
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 20; ++x) {
            CHECK(image.at(x, y)[0] == Approx(0.5 + 0.4 * ((x + 0.5) / 10 - 1)).margin(0.005));
            CHECK(image.at(x, y)[1] == Approx(0.5 - 0.4 * ((y + 0.5) / 10 - 1)).margin(0.005));
            CHECK(image.at(x, y)[2] == Approx(0.25));
        }
    }
    scene.color_mesh(0, Points());
    CHECK(render::render(scene, from_above(2.0), small_picture(4, 4)).image.pixels[0] == Approx(0.7f));
    CHECK_THROWS_AS(scene.color_mesh(0, Points::Zero(5, 3)), InvalidMesh);
    options.vertex_colors = Points::Zero(3, 3);
    CHECK_THROWS_AS(scene.add_mesh(plane.V, plane.F, options), InvalidMesh);
    CHECK(scene.mesh_count() == 1);
}

TEST_CASE("the colour map runs from dark blue to yellow with rising lightness") {
    double before = -1.0;
    for (int i = 0; i <= 100; ++i) {
        const Color c = viridis(i / 100.0);
        CHECK((c >= 0.0f && c <= 1.0f).all());
        const double lightness =
            std::cbrt(static_cast<double>(0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2]));
        CHECK(lightness > before);
        if (i > 0) CHECK(lightness - before == Approx(0.0063).margin(0.0045));  // nearly even steps
        before = lightness;
    }
    CHECK(viridis(0.0)[2] > viridis(0.0)[1]);
    CHECK(viridis(1.0)[0] > 5.0f * viridis(1.0)[2]);
    CHECK((viridis(-3.0) == viridis(0.0)).all());
    CHECK((viridis(9.0) == viridis(1.0)).all());
    CHECK(viridis(std::numeric_limits<double>::quiet_NaN())[0] == 0.2f);
    const Eigen::Vector3d values(2.0, 3.0, 4.0);
    const auto colors = viridis_colors(values, 2.0, 4.0);
    CHECK(colors(0, 2) == Approx(viridis(0.0)[2]));
    CHECK(colors(1, 1) == Approx(viridis(0.5)[1]));
    CHECK(colors(2, 0) == Approx(viridis(1.0)[0]));
}

TEST_CASE("drawn edges have their width in pixels, near and far, head on and slanted") {
    // The diagonal of the square, and its sides at the picture's border.
    const Shape plane = square(1.0, 0.0);
    for (const Camera& camera : {from_above(2.0), from_above(20.0), from_above(2.0, 3.0)}) {
        for (float width : {1.0f, 3.0f}) {
            Scene scene;
            MeshOptions options;
            options.normals = Normals::Flat;
            options.material.base_color.setOnes();
            options.material.wire_width = width;
            options.material.wire_color.setZero();
            scene.add_mesh(plane.V, plane.F, options);
            scene.sky.radiance.setOnes();
            RenderOptions picture = small_picture(100, 64);
            picture.max_scatter = 1;
            const Image image = render::render(scene, camera, picture).image;
            // Darkness along the middle row, which the diagonal crosses under an angle.
            const PictureCamera view(camera, 100, 100);
            const Eigen::Vector2d a = view.project({-0.1, -0.1, 0.0}).value(),
                                  b = view.project({0.1, 0.1, 0.0}).value();
            const double sine = std::abs(b.y() - a.y()) / (b - a).norm();
            double dark = 0.0;
            for (int y = 48; y < 52; ++y) {
                for (int x = 20; x < 80; ++x) dark += (1.0 - static_cast<double>(image.at(x, y)[0])) / 4;
            }
            INFO("width " << width);
            CHECK(dark * sine == Approx(width).epsilon(0.04));
        }
    }
}
