#include "render/program/figure_estimate.h"

#include <algorithm>
#include <cmath>

#include "morph/shapes/shapes.h"
#include "render/figure/clips.h"
#include "render/figure/mesh_source.h"
#include "render/figure/stopwatch.h"
#include "render/figure/subject.h"

namespace automorph::program {
namespace {

// Seconds, measured at the project's own figures on two cores; "per thousand" is of both shapes' triangles.
constexpr double kHead = 1.5, kHeadPerThousand = 0.09;  // generating one
constexpr double kCheckPerThousand = 0.03;              // the frames of one row
constexpr double kPanels = 0.4;                         // maps and features of one row
constexpr double kMovePerThousand = 0.002;              // the surface of one picture, before its paths
constexpr double kEncoderStart = 0.3;                   // of a video

/// Of this machine.
struct Speed {
    double paths_per_second = 1;
    double denoising_per_pixel = 0;  ///< seconds; 0 if the figure's pictures stay as they are
};

/// Pictures an ellipsoid in the figure's light.
Speed measured_speed(const FigureConfig& config, const FigureOptions& options) {
    constexpr int kSize = 128, kSpp = 16;
    ShapeOptions shape;
    shape.triangles = 20000;
    const Mesh mesh = ellipsoid({1, 0.8, 0.6}, shape);
    FigureOptions quiet = options;
    quiet.progress = {};
    const Shooting shooting = shooting_of(config.picture, quiet, {kSize, kSize, kSpp}, {&mesh.V});
    Subject subject(shooting, mesh.V, mesh.F);
    const Stopwatch whole;
    const FigureCell cell = subject.shoot(mesh.V, {});
    Speed speed;
    speed.paths_per_second = static_cast<double>(cell.samples) / std::max(cell.seconds, 1e-3);
    if (config.picture.denoise || options.denoise)
        speed.denoising_per_pixel = std::max(0.0, whole.seconds() - cell.seconds) / (kSize * kSize);
    return speed;
}

double morph_seconds(const RowConfig& row, double thousands) {
    switch (row.alignment) {
        case Alignment::None:
            return 0.01 * thousands;
        case Alignment::Registration:
        case Alignment::Features:
            return 0.1 + 0.015 * thousands;
        case Alignment::Dense:
            return 0.3 + 0.03 * thousands;
    }
    return 0;
}

/// Of a shape as asked for, of a file as it is.
double thousands_of(const MeshConfig& mesh, const std::string& name) {
    return 1e-3 * (mesh.file.empty() ? mesh.triangles : make_mesh(mesh, name).mesh.triangle_count());
}

double mesh_seconds(const MeshConfig& mesh, double thousands) {
    const bool is_head = mesh.file.empty() && mesh.shape == MeshConfig::Shape::Head;
    return is_head ? kHead + kHeadPerThousand * thousands : 0.0;
}

}  // namespace

Estimate estimate(const FigureConfig& config, const FigureOptions& options, const PictureCounts& counts) {
    const Speed speed = measured_speed(config, options);
    double thousands = thousands_of(config.source, "source");
    Estimate result;
    result.meshes = mesh_seconds(config.source, thousands);
    if (!config.rows.empty()) {
        const double target = thousands_of(config.target, "target");
        result.meshes += mesh_seconds(config.target, target);
        thousands += target;
    }
    for (const RowConfig& row : config.rows) result.morphs += morph_seconds(row, thousands);
    const auto rows = static_cast<double>(counts.rows);
    if (config.show == Show::Morph) result.checks = rows * (kPanels + kCheckPerThousand * thousands);

    const auto pictures = [&](double count, double pixels, double paths) {
        const double each = pixels * paths / speed.paths_per_second + pixels * speed.denoising_per_pixel +
                            kMovePerThousand * thousands;
        return count * each;
    };
    result.pictures = pictures(rows * static_cast<double>(counts.columns),
                               config.picture.width * config.picture.height * options.scale * options.scale,
                               options.spp.value_or(config.picture.spp));
    // Adaptive sampling spares about half of a video's paths.
    constexpr double kTaken = 0.5;
    const VideoSize video = video_size(config);
    const double frames = counts.stills * rows + counts.turntable;
    if (frames > 0) {
        result.videos =
            pictures(frames, static_cast<double>(video.width) * video.height, kTaken * config.video.spp) +
            kEncoderStart * (rows + 1);
    }
    return result;
}

}  // namespace automorph::program
