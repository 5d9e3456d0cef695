#include "render/studio/studio.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "morph/mesh/errors.h"

namespace automorph::render {
namespace {

// Lengths in radii of the bounds.
constexpr double kGroundSide = 60.0;  // beyond, the background is the same
constexpr double kGroundGap = 1e-3;   // under the lowest point

/// A square light as a photographer places it: seen from the shape, so much of the way towards the camera, to
/// its right and upwards.
struct StudioLight {
    double towards_camera, right, up;
    double distance, side;  ///< radii; large lights make soft shadows
    float irradiance;       ///< at the centre of the bounds
    Color tint;
};

// The key models the shape from the upper left, the fill opens its shadows from the right, so high that its
// own shadow stays near. With the sky, clay that faces the key comes to 0.8.
const std::array<StudioLight, 2> kLights{{
    {0.60, -0.70, 0.85, 4.0, 2.2, 2.28f, {1.02f, 1.0f, 0.96f}},
    {0.85, 0.80, 0.60, 4.0, 3.2, 0.36f, {0.96f, 1.0f, 1.04f}},
}};
constexpr float kSkyRadiance = 0.18f;

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

    for (const StudioLight& each : kLights) {
        const Eigen::Vector3d to_light =
            (-each.towards_camera * level + each.right * right + each.up * up).normalized();
        const Eigen::Vector3d center = bounds.center() + each.distance * radius * to_light;
        const auto ratio = static_cast<float>(each.distance / each.side);
        RectangleLight light =
            square_light(center.cast<float>(), bounds.center().cast<float>(),
                         static_cast<float>(each.side * radius), each.irradiance * ratio * ratio * each.tint);
        light.visible_to_camera = false;
        scene.lights.push_back(light);
    }
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
