#include "render/turntable/stage.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "morph/mesh/errors.h"
#include "render/camera/framing.h"
#include "render/math/angle.h"

namespace automorph::turntable {
namespace {

/// Rows: right, level view, up.
Eigen::Matrix3d world_axes(const StageOptions& options) {
    constexpr double kLeastSine = 1e-6;  // between view and up
    const Eigen::Vector3d up = options.up.normalized(), right = options.view.normalized().cross(up);
    if (!(up.allFinite() && options.up.norm() > 0)) throw ConfigError("turntable: the up axis has no length");
    if (!(right.allFinite() && right.norm() > kLeastSine))
        throw ConfigError("turntable: the view is along the up axis; give another one");
    Eigen::Matrix3d rows;
    rows.row(0) = right.normalized();
    rows.row(1) = up.cross(right.normalized());
    rows.row(2) = up;
    return rows;
}

/// About the world's axis.
Eigen::Matrix3d turn(double degrees) {
    return Eigen::AngleAxisd(degrees * render::kRadians, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

}  // namespace

void check(const StageOptions& options) {
    world_axes(options);
    if (!(options.elevation >= 0 && options.elevation < 90)) {
        throw ConfigError(
            fmt::format("turntable: the elevation is {} degrees; it must be in [0, 90)", options.elevation));
    }
}

Stage::Stage(Shape shape, const std::vector<Moment>& moments, const StageOptions& options)
    : shape_(std::move(shape)),
      options_(options),
      to_world_(world_axes(options)),
      scene_({.embree_config = options.embree_config}) {
    check(options);
    if (moments.empty()) throw ConfigError("turntable: there are no frames");
    std::set<double> distinct;
    for (const Moment& moment : moments) distinct.insert(moment.alpha);
    const std::vector<double> alphas(distinct.begin(), distinct.end());
    place_axis(alphas);
    frame(alphas, moments);
    alpha_ = alphas.front();
    render::MeshOptions surface;
    surface.normals = options.normals;
    surface.material = render::clay();
    mesh_ = scene_.add_mesh(standing(alpha_), shape_.triangles, surface);
    show(alpha_);
    furnish();
}

Points Stage::upright(double alpha) const {
    return shape_.vertices(alpha) * to_world_.transpose();
}

Points Stage::standing(double alpha) const {
    Points V = upright(alpha);
    render::Bounds box;
    box.add(V);
    return V.rowwise() - Eigen::RowVector3d(axis_.x(), axis_.y(), box.lower.z());
}

void Stage::place_axis(const std::vector<double>& alphas) {
    render::Bounds box;
    for (const double alpha : alphas) box.add(upright(alpha));
    if (!(box.lower.array() <= box.upper.array()).all())
        throw Error("turntable: the shape has no finite vertex");
    axis_ = box.center();
}

void Stage::frame(const std::vector<double>& alphas, const std::vector<Moment>& moments) {
    const double slope = options_.elevation * render::kRadians;
    render::FramingOptions framing_options;
    framing_options.direction = {0, std::cos(slope), -std::sin(slope)};
    framing_options.vertical_fov = options_.fov;
    framing_options.aspect = static_cast<double>(options_.width) / options_.height;
    framing_options.margin = options_.margin;
    render::Framing framing(framing_options);

    const auto [least, most] =
        std::minmax_element(moments.begin(), moments.end(),
                            [](const Moment& a, const Moment& b) { return a.degrees < b.degrees; });
    // A loop leaves out the frame that would be its first again: it goes all round, nevertheless.
    const double step =
        moments.size() > 1 ? (most->degrees - least->degrees) / static_cast<double>(moments.size() - 1) : 0.0;
    const render::Sweep sweep{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), least->degrees,
                              most->degrees + step};
    double radius = 0, height = 0;
    for (const double alpha : alphas) {
        const Points V = standing(alpha);
        framing.add(V, sweep);
        for (const auto& p : V.rowwise()) {
            if (!p.allFinite()) continue;
            radius = std::max(radius, p.head<2>().norm());
            height = std::max(height, p.z());
        }
    }
    camera_ = framing.camera();
    bounds_.lower = {-radius, -radius, 0};
    bounds_.upper = {radius, radius, height};
}

void Stage::show(double alpha) {
    if (shape_.shading) scene_.correct_normals(mesh_, shape_.shading(alpha) * to_world_.transpose());
    scene_.move_mesh(mesh_, standing(alpha));
    alpha_ = alpha;
}

void Stage::furnish() {
    render::add_studio(scene_, camera_, bounds_);
    lights_ = scene_.lights;
}

double Stage::samples() const {
    return static_cast<double>(options_.width) * options_.height * options_.spp;
}

render::Camera Stage::camera(double degrees) const {
    const Eigen::Matrix3d back = turn(-degrees);
    render::Camera camera = camera_;
    camera.position = back * camera_.position;
    camera.target = back * camera_.target;
    return camera;
}

render::RenderResult Stage::picture(const Moment& moment, int frame,
                                    const std::function<void(double)>& progress) {
    if (moment.alpha != alpha_) show(moment.alpha);
    const Eigen::Matrix3f back = turn(-moment.degrees).cast<float>();
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        scene_.lights[i].center = back * lights_[i].center;
        scene_.lights[i].edge_u = back * lights_[i].edge_u;
        scene_.lights[i].edge_v = back * lights_[i].edge_v;
    }
    render::RenderOptions settings;
    settings.width = options_.width;
    settings.height = options_.height;
    settings.spp = options_.spp;
    settings.seed = options_.seed;
    settings.frame = static_cast<std::uint32_t>(frame);
    settings.threads = options_.threads;
    settings.progress = progress;
    return render::render(scene_, camera(moment.degrees), settings);
}

}  // namespace automorph::turntable
