#include "render/figure/lighting.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "morph/mesh/errors.h"
#include "render/image/image_file.h"
#include "render/math/angle.h"

namespace automorph {
namespace {

/// The middle of the map lies behind the target, turned to the left by `degrees`.
render::MapAxes axes_of(const PictureConfig& picture, const render::Camera& camera) {
    constexpr double kFullTurn = 6.28318530717958648;
    const double turns = picture.light.rotation / 360.0;
    const auto [sine, cosine] = render::sine_and_cosine(kFullTurn * (turns - std::nearbyint(turns)));
    const Eigen::Vector3d up = camera.up.normalized();
    const Eigen::Vector3d right =
        render::cross(Eigen::Vector3d(camera.target - camera.position), up).normalized();
    const Eigen::Vector3d level = render::cross(up, right);
    const Eigen::Vector3d middle = cosine * level - sine * right;
    return {middle.cast<float>(), render::cross(up, middle).cast<float>(), up.cast<float>()};
}

}  // namespace

std::shared_ptr<const render::EquirectangularMap> load_sky(const PictureConfig& picture,
                                                           const render::Camera& camera) {
    if (picture.light.kind != LightConfig::Kind::Sky) return nullptr;
    render::Image image = render::read_image(picture.light.map).image;
    const auto strength = static_cast<float>(picture.light.strength);
    for (float& value : image.pixels) value *= strength;
    try {
        return std::make_shared<const render::EquirectangularMap>(image, axes_of(picture, camera));
    } catch (const ConfigError& error) {
        throw ConfigError(fmt::format("{}: {}", picture.light.map.string(), error.what()));
    }
}

void add_light(render::Scene& scene, const PictureConfig& picture, const render::Camera& camera,
               const render::Bounds& bounds, std::shared_ptr<const render::EquirectangularMap> map) {
    const LightConfig& light = picture.light;
    const render::Color background = color_of(picture.background);
    const auto strength = static_cast<float>(light.strength);
    if (light.kind == LightConfig::Kind::Studio) {
        render::add_studio(scene, camera, bounds,
                           {background, picture.ground, static_cast<float>(light.rim), strength});
        return;
    }
    if (light.kind == LightConfig::Kind::Gradient) {
        scene.sky.gradient =
            render::SkyGradient{strength * color_of(light.zenith), strength * color_of(light.horizon),
                                strength * color_of(light.ground), picture.up.normalized().cast<float>()};
    }
    scene.sky.map = std::move(map);
    if (!light.visible) scene.background = background;
    render::add_ground(scene, camera, bounds, picture.ground, background);
}

}  // namespace automorph
