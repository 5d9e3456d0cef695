#pragma once

#include <memory>

#include "render/camera/camera.h"
#include "render/figure/config.h"
#include "render/geometry/scene.h"
#include "render/light/equirectangular_map.h"
#include "render/studio/studio.h"

namespace automorph {

/// A colour of a config.
inline render::Color color_of(const Eigen::Vector3d& rgb) {
    return rgb.cast<float>().array();
}

/// The picture of the sky that a config names, turned as it says; null where there is none.
/// @param camera  behind whose target the middle of an unturned map lies
/// @throws IoError     the file cannot be read
/// @throws ConfigError it holds no radiances; the message names the file
std::shared_ptr<const render::EquirectangularMap> load_sky(const PictureConfig& picture,
                                                           const render::Camera& camera);

/// Lights, background and ground of a picture.
/// @param map  load_sky()'s
void add_light(render::Scene& scene, const PictureConfig& picture, const render::Camera& camera,
               const render::Bounds& bounds, std::shared_ptr<const render::EquirectangularMap> map);

}  // namespace automorph
