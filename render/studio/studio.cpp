#include "render/studio/studio.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "morph/mesh/errors.h"
#include "render/studio/backdrop.h"

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

// The rim comes from behind, so high that the shadow it throws towards the camera stays short, and is large,
// so that this shadow is soft.
const StudioLight kRim{-0.75, 0.55, 1.25, 4.0, 2.6, 2.28f, {0.97f, 1.0f, 1.03f}};

constexpr float kPaperAlbedo = 0.8f;  // of a white ground

/// The camera's axes, with one that is the view without its slope.
struct Axes {
    Eigen::Vector3d right, up, level;

    explicit Axes(const Camera& camera) : up(camera.up.normalized()) {
        const Eigen::Vector3d forward = (camera.target - camera.position).normalized();
        right = cross(forward, up).normalized();
        level = cross(up, right);
    }
};

double radius_of(const Bounds& bounds) {
    if (!(bounds.lower.array() <= bounds.upper.array()).all())
        throw Error("studio: there is nothing to light");
    return std::max(bounds.radius(), 1e-30);
}

RectangleLight placed(const StudioLight& each, const Axes& axes, const Bounds& bounds, double radius) {
    const Eigen::Vector3d to_light =
        (-each.towards_camera * axes.level + each.right * axes.right + each.up * axes.up).normalized();
    const Eigen::Vector3d center = bounds.center() + each.distance * radius * to_light;
    const auto ratio = static_cast<float>(each.distance / each.side);
    RectangleLight light =
        square_light(center.cast<float>(), bounds.center().cast<float>(),
                     static_cast<float>(each.side * radius), each.irradiance * ratio * ratio * each.tint);
    light.visible_to_camera = false;
    return light;
}

/// The floor's middle, under the lowest corner of the box.
FloorPlace floor_under(const Bounds& bounds, const Axes& axes, double radius) {
    double lowest = 1e300;  // along the up vector
    for (int corner = 0; corner < 8; ++corner) {
        const Eigen::Vector3d p((corner & 1 ? bounds.upper : bounds.lower).x(),
                                (corner & 2 ? bounds.upper : bounds.lower).y(),
                                (corner & 4 ? bounds.upper : bounds.lower).z());
        lowest = std::min(lowest, p.dot(axes.up));
    }
    const Eigen::Vector3d below =
        bounds.center() + (lowest - bounds.center().dot(axes.up) - kGroundGap * radius) * axes.up;
    return {below, axes.right, axes.level, axes.up, radius};
}

void add_shadow_catcher(Scene& scene, const FloorPlace& floor) {
    const Eigen::Vector3d a = 0.5 * kGroundSide * floor.radius * floor.right,
                          b = 0.5 * kGroundSide * floor.radius * floor.level;
    Points V(4, 3);
    V << (floor.below - a - b).transpose(), (floor.below + a - b).transpose(),
        (floor.below + a + b).transpose(), (floor.below - a + b).transpose();
    Triangles F(2, 3);
    F << 0, 1, 2, 0, 2, 3;
    MeshOptions ground;
    ground.normals = Normals::Flat;
    ground.material.base_color.setConstant(0.5f);
    ground.material.shadow_catcher = true;
    scene.add_mesh(V, F, ground);
}

void add_floor(Scene& scene, const FloorPlace& place, Ground ground, const Color& background, bool wall) {
    if (ground == Ground::None) return;
    if (ground == Ground::Shadow) return add_shadow_catcher(scene, place);
    const Backdrop sheet = make_backdrop(place, {kPaperAlbedo * background, ground == Ground::Checker, wall});
    scene.add_mesh(sheet.V, sheet.F, sheet.options);
}

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
    const double radius = radius_of(bounds);
    const Axes axes(camera);
    const std::size_t first = scene.lights.size();
    for (const StudioLight& each : kLights) scene.lights.push_back(placed(each, axes, bounds, radius));
    if (options.rim > 0.0f) {
        scene.lights.push_back(placed(kRim, axes, bounds, radius));
        scene.lights.back().radiance *= options.rim;
    }
    for (std::size_t i = first; i < scene.lights.size(); ++i) scene.lights[i].radiance *= options.strength;
    scene.sky.radiance = options.strength * kSkyRadiance * Color(0.97f, 1.0f, 1.04f);
    scene.background = options.background;
    add_floor(scene, floor_under(bounds, axes, radius), options.ground, options.background, true);
}

void add_ground(Scene& scene, const Camera& camera, const Bounds& bounds, Ground ground,
                const Color& background) {
    const double radius = radius_of(bounds);
    add_floor(scene, floor_under(bounds, Axes(camera), radius), ground, background, false);
}

}  // namespace automorph::render
