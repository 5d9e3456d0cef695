#include "render/figure/subject.h"

#include <algorithm>

#include "render/figure/mesh_source.h"
#include "render/geometry/embree_scene.h"
#include "render/integrator/render.h"

namespace automorph {
namespace {

render::Color color(const Eigen::Vector3d& rgb) {
    return rgb.cast<float>().array();
}

render::FramingOptions framing_options(const PictureConfig& picture, const Film& film) {
    render::FramingOptions options;
    options.direction = picture.view;
    options.up = picture.up;
    options.vertical_fov = picture.fov;
    options.aspect = static_cast<double>(film.width) / film.height;
    options.margin = picture.margin;
    return options;
}

}  // namespace

ShootingPlan::ShootingPlan(const PictureConfig& picture, const FigureOptions& options, const Film& film)
    : picture_(picture), options_(options), film_(film), framing_(framing_options(picture, film)) {}

void ShootingPlan::add(const Points& V) {
    framing_.add(V);
    bounds_.add(V);
}

Shooting ShootingPlan::shooting() const {
    return {picture_, options_, framing_.camera(), bounds_, film_.width, film_.height, film_.spp};
}

Shooting shooting_of(const PictureConfig& picture, const FigureOptions& options, const Film& film,
                     const std::vector<const Points*>& frames) {
    ShootingPlan plan(picture, options, film);
    for (const Points* V : frames) plan.add(*V);
    return plan.shooting();
}

Points turned(const Points& V, const Eigen::RowVector3d& centre, const Eigen::Vector3d& axis,
              double degrees) {
    const Eigen::Matrix3d R = rotation_matrix({axis, degrees});
    return ((V.rowwise() - centre) * R.transpose()).rowwise() + centre;
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

FigureCell Subject::shoot(const Points& V, const std::function<void(double)>& progress, std::uint32_t frame) {
    render::RenderOptions settings;
    settings.width = shooting_.width;
    settings.height = shooting_.height;
    settings.spp = shooting_.spp;
    settings.seed = shooting_.picture.seed;
    settings.frame = frame;
    settings.adaptive_error = shooting_.adaptive_error;
    settings.pilot = std::min(settings.pilot, std::max(2, shooting_.spp / 4));
    settings.threads = shooting_.options.threads;
    settings.progress = progress;
    scene_.move_mesh(mesh_, V);
    render::RenderResult result = render::render(scene_, shooting_.camera, settings);
    FigureCell cell;
    cell.image = std::move(result.image);
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
