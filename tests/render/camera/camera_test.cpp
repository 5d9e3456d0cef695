#include "render/camera/camera.h"

#include <cmath>

#include "morph/mesh/errors.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::render;

namespace {

Camera looking_along_y() {
    Camera camera;
    camera.position = {1.0, 2.0, 3.0};
    camera.target = {1.0, 7.0, 3.0};
    camera.vertical_fov = 90.0;
    return camera;
}

}  // namespace

TEST_CASE("rays go through the picture's middle, sides and corners") {
    const PictureCamera camera(looking_along_y(), 200, 100);  // half the picture: 2 x 1 at distance 1
    CHECK((camera.direction(100, 50) - Vec3(0, 1, 0)).norm() < 1e-6f);
    CHECK((camera.direction(200, 50) - Vec3(2, 1, 0).normalized()).norm() < 1e-6f);
    CHECK((camera.direction(100, 0) - Vec3(0, 1, 1).normalized()).norm() < 1e-6f);
    CHECK((camera.direction(0, 100) - Vec3(-2, 1, -1).normalized()).norm() < 1e-6f);
    CHECK((camera.origin() - Vec3(1, 2, 3)).norm() == 0.0f);
}

TEST_CASE("points project to where the ray through them leaves") {
    const PictureCamera camera(looking_along_y(), 200, 100);
    CHECK((camera.project({1, 9, 3}).value() - Eigen::Vector2d(100, 50)).norm() < 1e-12);
    CHECK((camera.project({5, 4, 5}).value() - Eigen::Vector2d(200, 0)).norm() < 1e-12);
    for (double x : {3.5, 100.0, 170.25}) {
        for (double y : {0.5, 61.0, 99.0}) {
            const Vec3 d = camera.direction(static_cast<float>(x), static_cast<float>(y));
            const Eigen::Vector3d p = Eigen::Vector3d(1, 2, 3) + 7.0 * d.cast<double>();
            CHECK((camera.project(p).value() - Eigen::Vector2d(x, y)).norm() < 1e-4);
        }
    }
}

TEST_CASE("points beside and behind the camera have no place in the picture") {
    const PictureCamera camera(looking_along_y(), 200, 100);
    CHECK_FALSE(camera.project({1, 1, 3}).has_value());
    CHECK_FALSE(camera.project({1, 2, 3}).has_value());
    CHECK_FALSE(camera.project({4, 2, 3}).has_value());
}

TEST_CASE("what is not a camera is refused") {
    Camera camera = looking_along_y();
    CHECK_THROWS_AS(PictureCamera(camera, 0, 10), ConfigError);
    SECTION("position and target coincide") {
        camera.target = camera.position;
    }
    SECTION("up is along the view") {
        camera.up = {0.0, -3.0, 0.0};
    }
    SECTION("up is zero") {
        camera.up.setZero();
    }
    SECTION("field of view of 180 degrees") {
        camera.vertical_fov = 180.0;
    }
    SECTION("field of view that is not a number") {
        camera.vertical_fov = std::nan("");
    }
    SECTION("position that is not finite") {
        camera.position.x() = INFINITY;
    }
    CHECK_THROWS_AS(PictureCamera(camera, 10, 10), ConfigError);
}
