#include "render/studio/studio.h"

#include <algorithm>
#include <cmath>

#include "morph/mesh/errors.h"

namespace automorph::render {
namespace {

// Lengths in radii of the bounds.
constexpr double kKeyDistance = 4.0;
constexpr double kKeySide = 2.8;      // a large light: shadows with soft edges
constexpr double kGroundSide = 60.0;  // beyond, the background is the same
constexpr double kGroundGap = 1e-3;   // under the lowest point

// Irradiance of the key light at the centre, and radiance of the sky: clay that faces the key comes to 0.8.
constexpr float kKeyIrradiance = 2.25f;
constexpr float kSkyRadiance = 0.26f;

}  // namespace

void Bounds::add(const Points& V) {
    for (Eigen::Index i = 0; i < V.rows(); ++i) {
        if (!V.row(i).allFinite()) continue;
        lower = lower.cwiseMin(V.row(i).transpose());
        upper = upper.cwiseMax(V.row(i).transpose());
    }
}

Material clay() {
    Material material;
    material.base_color = {0.77f, 0.74f, 0.70f};
    return material;
}

void add_studio(Scene& scene, const Camera& camera, const Bounds& bounds, const StudioOptions& options) {
    if (!(bounds.lower.array() <= bounds.upper.array()).all())
        throw Error("studio: there is nothing to light");
    const double radius = std::max(bounds.radius(), 1e-30);
    const Eigen::Vector3d forward = (camera.target - camera.position).normalized();
    const Eigen::Vector3d up = camera.up.normalized();
    const Eigen::Vector3d right = cross(forward, up).normalized();
    const Eigen::Vector3d level = cross(up, right);  // the view without its slope

    const Eigen::Vector3d to_key = (-0.6 * level - 0.5 * right + 1.05 * up).normalized();
    const Eigen::Vector3d key = bounds.center() + kKeyDistance * radius * to_key;
    const auto distance = static_cast<float>(kKeyDistance * radius),
               side = static_cast<float>(kKeySide * radius);
    const float radiance = kKeyIrradiance * distance * distance / (side * side);
    RectangleLight light = square_light(key.cast<float>(), bounds.center().cast<float>(), side,
                                        radiance * Color(1.02f, 1.0f, 0.96f));
    light.visible_to_camera = false;
    scene.lights.push_back(light);
    scene.sky.radiance = kSkyRadiance * Color(0.97f, 1.0f, 1.04f);
    scene.background = options.background;

    if (!options.ground) return;
    double lowest = 1e300;  // of the box's corners along the up vector
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d p((corner & 1 ? bounds.upper : bounds.lower).x(),
                                (corner & 2 ? bounds.upper : bounds.lower).y(),
                                (corner & 4 ? bounds.upper : bounds.lower).z());
        lowest = std::min(lowest, p.dot(up));
    }
    const Eigen::Vector3d below =
        bounds.center() + (lowest - bounds.center().dot(up) - kGroundGap * radius) * up;
    const Eigen::Vector3d a = 0.5 * kGroundSide * radius * right, b = 0.5 * kGroundSide * radius * level;
    Points V(4, 3);
    V << (below - a - b).transpose(), (below + a - b).transpose(), (below + a + b).transpose(),
        (below - a + b).transpose();
    Triangles F(2, 3);
    F << 0, 1, 2, 0, 2, 3;
    MeshOptions ground;
    ground.normals = Normals::Flat;
    ground.material.base_color.setConstant(0.5f);
    ground.material.shadow_catcher = true;
    scene.add_mesh(V, F, ground);
}

}  // namespace automorph::render
