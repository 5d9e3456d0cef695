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

std::vector<double> distinct_alphas(const std::vector<Moment>& moments) {
    std::set<double> distinct;
    for (const Moment& moment : moments) distinct.insert(moment.alpha);
    return {distinct.begin(), distinct.end()};
}

std::vector<Moment> middles(const std::vector<Exposure>& frames) {
    std::vector<Moment> moments;
    for (const Exposure& frame : frames) moments.push_back(frame.middle());
    return moments;
}

/// Degrees from those of the middle.
std::vector<Moment> relative(const Exposure& exposure) {
    std::vector<Moment> steps = exposure.steps;
    for (Moment& step : steps) step.degrees -= exposure.middle().degrees;
    return steps;
}

}  // namespace

void check(const StageOptions& options) {
    world_axes(options);
    if (!(options.elevation >= 0 && options.elevation < 90)) {
        throw ConfigError(
            fmt::format("turntable: the elevation is {} degrees; it must be in [0, 90)", options.elevation));
    }
}

Stage::Stage(Shape shape, const std::vector<Exposure>& frames, const StageOptions& options)
    : shape_(std::move(shape)),
      options_(options),
      to_world_(world_axes(options)),
      scene_({.embree_config = options.embree_config}) {
    check(options);
    if (frames.empty()) throw ConfigError("turntable: there are no frames");
    place_axis(frames);
    frame(frames);
    render::MeshOptions surface;
    surface.normals = options.normals;
    surface.material = render::clay();
    surface.time_steps = static_cast<int>(frames.front().steps.size());
    const Exposure& first = frames.front();
    mesh_ = scene_.add_mesh(standing(first.middle().alpha), shape_.triangles, surface);
    show(relative(first));
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

void Stage::place_axis(const std::vector<Exposure>& frames) {
    render::Bounds box;
    for (const double alpha : distinct_alphas(middles(frames))) box.add(upright(alpha));
    if (!(box.lower.array() <= box.upper.array()).all())
        throw Error("turntable: the shape has no finite vertex");
    axis_ = box.center();
}

void Stage::frame(const std::vector<Exposure>& frames) {
    const double slope = options_.elevation * render::kRadians;
    render::FramingOptions framing_options;
    framing_options.direction = {0, std::cos(slope), -std::sin(slope)};
    framing_options.vertical_fov = options_.fov;
    framing_options.aspect = static_cast<double>(options_.width) / options_.height;
    framing_options.margin = options_.margin;
    render::Framing framing(framing_options);

    const std::vector<Moment> moments = middles(frames);
    const auto by_degrees = [](const Moment& a, const Moment& b) { return a.degrees < b.degrees; };
    const auto [least, most] = std::minmax_element(moments.begin(), moments.end(), by_degrees);
    // A loop leaves out the frame that would be its first again: it goes all round, nevertheless.
    const double step =
        moments.size() > 1 ? (most->degrees - least->degrees) / static_cast<double>(moments.size() - 1) : 0.0;
    // What the shutter sees before and after.
    std::vector<Moment> all;
    for (const Exposure& each : frames) all.insert(all.end(), each.steps.begin(), each.steps.end());
    const auto [first, last] = std::minmax_element(all.begin(), all.end(), by_degrees);
    const render::Sweep sweep{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), first->degrees,
                              std::max(last->degrees, most->degrees + step)};
    double radius = 0, height = 0;
    for (const double alpha : distinct_alphas(all)) {
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

void Stage::show(const std::vector<Moment>& steps) {
    std::vector<Points> places, corrections;
    for (const Moment& step : steps) {
        const auto turned = [&](const Points& rows) {
            return step.degrees == 0 ? rows : Points(rows * turn(step.degrees).transpose());
        };
        places.push_back(turned(standing(step.alpha)));
        if (shape_.shading) corrections.push_back(turned(shape_.shading(step.alpha) * to_world_.transpose()));
    }
    if (shape_.shading) scene_.correct_normals(mesh_, corrections);
    scene_.move_mesh(mesh_, places);
    shown_ = steps;
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

render::RenderResult Stage::picture(const Exposure& exposure, int frame,
                                    const std::function<void(double)>& progress) {
    if (std::vector<Moment> steps = relative(exposure); steps != shown_) show(steps);
    const double degrees = exposure.middle().degrees;
    const Eigen::Matrix3f back = turn(-degrees).cast<float>();
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
    return render::render(scene_, camera(degrees), settings);
}

}  // namespace automorph::turntable
