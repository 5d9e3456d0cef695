#include "render/figure/subject.h"

#include <algorithm>

#include "render/denoise/denoise.h"
#include "render/figure/lighting.h"
#include "render/figure/mesh_source.h"
#include "render/film/color_map.h"
#include "render/geometry/embree_scene.h"
#include "render/integrator/render.h"

namespace automorph {
namespace {

render::FramingOptions framing_options(const PictureConfig& picture, const Film& film) {
    render::FramingOptions options;
    options.direction = picture.view;
    options.up = picture.up;
    options.vertical_fov = picture.fov;
    options.aspect = static_cast<double>(film.width) / film.height;
    options.margin = picture.margin;
    return options;
}

void add_lens(const LensConfig& lens, const render::Bounds& bounds, render::Camera& camera) {
    if (lens.radius == 0) return;
    const Eigen::Vector3d forward = (camera.target - camera.position).normalized();
    const double middle = (bounds.center() - camera.position).dot(forward);
    constexpr double kNearest = 0.05;  // of that distance: the sharp plane stays before the lens
    camera.lens_radius = lens.radius * middle;
    camera.focus_distance = std::max(kNearest * middle, middle + lens.focus * bounds.radius());
}

}  // namespace

ShootingPlan::ShootingPlan(const PictureConfig& picture, const FigureOptions& options, const Film& film)
    : picture_(picture), options_(options), film_(film), framing_(framing_options(picture, film)) {}

void ShootingPlan::add(const Points& V) {
    framing_.add(V);
    bounds_.add(V);
}

Shooting ShootingPlan::shooting() const {
    render::Camera camera = framing_.camera();
    add_lens(picture_.lens, bounds_, camera);
    return {.picture = picture_,
            .options = options_,
            .camera = camera,
            .bounds = bounds_,
            .width = film_.width,
            .height = film_.height,
            .spp = film_.spp,
            .adaptive_error = picture_.adaptive,
            .sky = load_sky(picture_, camera)};
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

render::Material material_of(const PictureConfig& picture, int width) {
    render::Material material;
    material.base_color = color_of(picture.albedo);
    material.metallic = static_cast<float>(picture.material.metallic);
    material.roughness = static_cast<float>(picture.material.roughness);
    material.specular = static_cast<float>(picture.material.specular);
    material.transmission = static_cast<float>(picture.material.transmission);
    material.ior = static_cast<float>(picture.material.ior);
    material.emission = color_of(picture.material.emission);
    // A figure made smaller looks the same.
    material.wire_width = static_cast<float>(picture.wireframe.width * width / picture.width);
    material.wire_color = color_of(picture.wireframe.color);
    return material;
}

Subject::Subject(const Shooting& shooting, const Points& V, const Triangles& F)
    : shooting_(shooting), scene_({.embree_config = shooting.options.embree_config}) {
    render::MeshOptions surface;
    surface.normals = shooting.picture.normals;
    surface.material = material_of(shooting.picture, shooting.width);
    surface.time_steps = shooting.time_steps;
    mesh_ = scene_.add_mesh(V, F, surface);
    add_light(scene_, shooting.picture, shooting.camera, shooting.bounds, shooting.sky);
}

void Subject::color(const Eigen::VectorXd& values, const ColorScale& scale) {
    scene_.color_mesh(mesh_, render::viridis_colors(values, scale.low, scale.high));
}

void Subject::correct_normals(const std::vector<Points>& steps) {
    scene_.correct_normals(mesh_, steps);
}

void Subject::mark(const std::vector<int>& vertices) {
    markers_.emplace(scene_, vertices, shooting_.picture.markers.radius * shooting_.bounds.radius(),
                     shooting_.time_steps);
}

FigureCell Subject::shoot(const Points& V, const std::function<void(double)>& progress, std::uint32_t frame) {
    return shoot(std::vector<Points>(static_cast<std::size_t>(shooting_.time_steps), V), progress, frame);
}

FigureCell Subject::shoot(const std::vector<Points>& steps, const std::function<void(double)>& progress,
                          std::uint32_t frame) {
    render::RenderOptions settings;
    settings.width = shooting_.width;
    settings.height = shooting_.height;
    settings.spp = shooting_.spp;
    settings.filter = shooting_.picture.filter;
    settings.seed = shooting_.picture.seed;
    settings.frame = frame;
    settings.adaptive_error = shooting_.adaptive_error;
    settings.pilot = std::min(settings.pilot, std::max(2, shooting_.spp / 4));
    settings.threads = shooting_.options.threads;
    settings.progress = progress;
    const bool denoise = shooting_.picture.denoise || shooting_.options.denoise;
    settings.layers = denoise || shooting_.options.layers;
    scene_.move_mesh(mesh_, steps);
    if (markers_) markers_->move(scene_, steps);
    render::RenderResult result = render::render(scene_, shooting_.camera, settings);
    FigureCell cell;
    if (denoise) {
        cell.image = render::denoise(result.image, *result.layers);
    } else {
        cell.image = std::move(result.image);
        cell.layers = std::move(result.layers);
    }
    cell.seconds = result.wall_seconds;
    cell.samples = result.samples;
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
