#include "render/figure/subject.h"

#include "render/camera/framing.h"
#include "render/geometry/embree_scene.h"
#include "render/integrator/render.h"

namespace automorph {
namespace {

render::Color color(const Eigen::Vector3d& rgb) {
    return rgb.cast<float>().array();
}

}  // namespace

Shooting shooting_of(const PictureConfig& picture, const FigureOptions& options, const Figure& figure,
                     const std::vector<const Points*>& frames) {
    render::FramingOptions framing_options;
    framing_options.direction = picture.view;
    framing_options.up = picture.up;
    framing_options.vertical_fov = picture.fov;
    framing_options.aspect = static_cast<double>(figure.width) / figure.height;
    framing_options.margin = picture.margin;
    render::Framing framing(framing_options);
    render::Bounds bounds;
    for (const Points* V : frames) {
        framing.add(*V);
        bounds.add(*V);
    }
    return {picture, options, framing.camera(), bounds, figure.width, figure.height, figure.spp};
}

Subject::Subject(const Shooting& shooting, const Points& V, const Triangles& F)
    : shooting_(shooting), scene_({.embree_config = shooting.options.embree_config, .refit = false}) {
    render::MeshOptions surface;
    surface.normals = shooting.picture.normals;
    surface.material.base_color = color(shooting.picture.albedo);
    mesh_ = scene_.add_mesh(V, F, surface);
    render::add_studio(scene_, shooting.camera, shooting.bounds,
                       {color(shooting.picture.background), shooting.picture.ground});
}

FigureCell Subject::shoot(const Points& V, const std::function<void(double)>& progress) {
    render::RenderOptions settings;
    settings.width = shooting_.width;
    settings.height = shooting_.height;
    settings.spp = shooting_.spp;
    settings.seed = shooting_.picture.seed;
    settings.threads = shooting_.options.threads;
    settings.layers = shooting_.options.layers;
    settings.progress = progress;
    scene_.move_mesh(mesh_, V);
    render::RenderResult result = render::render(scene_, shooting_.camera, settings);
    FigureCell cell;
    cell.image = std::move(result.image);
    cell.layers = std::move(result.layers);
    cell.seconds = result.wall_seconds;
    cell.rays = result.rays;
    cell.bad_samples = result.bad_samples;
    return cell;
}

bool Subject::sees(const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const {
    constexpr double kLift = 2e-3;  // of the bounds' radius: off the surface the point lies on
    const Eigen::Vector3d lifted = point + kLift * shooting_.bounds.radius() * normal;
    const Eigen::Vector3d to_camera = shooting_.camera.position - lifted;
    if (normal.dot(to_camera) <= 0.0) return false;
    const render::Ray ray{lifted.cast<float>(), to_camera.normalized().cast<float>()};
    return !scene_.embree().occluded(ray, static_cast<float>(to_camera.norm()));
}

}  // namespace automorph
