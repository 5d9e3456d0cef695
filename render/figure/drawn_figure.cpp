#include "render/figure/drawn_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "morph/report_of.h"
#include "render/figure/mesh_source.h"
#include "render/figure/panels.h"
#include "render/figure/stopwatch.h"

namespace automorph {
namespace {

void draw_map(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const Stopwatch loading;
    const InputMesh shape = make_mesh(config.source, "source");
    figure.load_seconds = loading.seconds();
    const Stopwatch mapping;
    const ShapeMap map = map_shape(shape);
    figure.morph_seconds = mapping.seconds();
    const Shooting shooting = shooting_of(config.picture, options, figure, {&shape.mesh.V});
    Report& report = figure.morphs.emplace_back();
    report.source = shape.report;
    report.maps = {map.report};
    figure.rows.push_back({{}, 0, map_panels(shooting, shape, map)});
    figure.camera = shooting.camera;
}

/// The shape turned about an axis through the middle of its bounding box.
Points turned(const Points& V, const Eigen::Vector3d& axis, double degrees) {
    const Eigen::Matrix3d R = rotation_matrix({axis, degrees});
    const Eigen::RowVector3d centre = 0.5 * (V.colwise().minCoeff() + V.colwise().maxCoeff());
    return ((V.rowwise() - centre) * R.transpose()).rowwise() + centre;
}

void picture_shape(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const Stopwatch loading;
    const InputMesh shape = make_mesh(config.source, "source");
    figure.load_seconds = loading.seconds();
    std::vector<Points> sides;
    std::vector<const Points*> frames;
    for (const double degrees : config.turns)
        sides.push_back(turned(shape.mesh.V, config.picture.up, degrees));
    for (const Points& side : sides) frames.push_back(&side);
    const Shooting shooting = shooting_of(config.picture, options, figure, frames);
    figure.camera = shooting.camera;
    figure.morphs.emplace_back().source = shape.report;
    FigureRow& row = figure.rows.emplace_back();
    Subject subject(shooting, shape.mesh.V, shape.mesh.F);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        FigureCell cell = subject.shoot(sides[i], [&](double fraction) {
            const double done = (static_cast<double>(i) + fraction) / static_cast<double>(sides.size());
            if (options.progress) options.progress("pictures", std::min(done, 0.999));
        });
        cell.label = fmt::format("{}\u00b0", config.turns[i]);
        row.cells.push_back(std::move(cell));
    }
    if (options.progress) options.progress("pictures", 1);
}

FigureRow draw_borders(const Shooting& shooting, const InputMesh& source, const InputMesh& target,
                       std::uint64_t seed, Report& report) {
    const BorderInsertion insertion = insert_borders(source, target, seed);
    report.source = source.report;
    report.target = target.report;
    report.registration = insertion.registration;
    report.border = report_of(insertion.border);
    return {{}, 0, border_panels(shooting, insertion)};
}

FigureRow draw_features(const Shooting& shooting, const InputMesh& source, const InputMesh& target,
                        std::uint64_t seed, RowConfig row, Report& report) {
    row.alignment = Alignment::Features;
    report = morph(source, target, row.morph_options(seed)).report();
    return {row, 0, feature_panels(shooting, source, target, report.features)};
}

}  // namespace

void draw_figure(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    if (config.show == Show::Shape) return picture_shape(config, options, figure);
    if (config.show == Show::Map) return draw_map(config, options, figure);
    const Stopwatch loading;
    const InputMesh source = make_mesh(config.source, "source"), target = make_mesh(config.target, "target");
    figure.load_seconds = loading.seconds();
    const Shooting shooting = shooting_of(config.picture, options, figure, {&source.mesh.V, &target.mesh.V});
    figure.camera = shooting.camera;
    if (config.show == Show::Borders) {
        figure.rows.push_back(
            draw_borders(shooting, source, target, config.seed, figure.morphs.emplace_back()));
        return;
    }
    for (const RowConfig& row : config.rows) {
        const std::string task = fmt::format("row {} ({})", figure.rows.size() + 1, row.label);
        if (options.progress) options.progress(task, 0);
        Report& report = figure.morphs.emplace_back();
        figure.rows.push_back(draw_features(shooting, source, target, config.seed, row, report));
        figure.rows.back().morph = figure.morphs.size() - 1;
        if (options.progress) options.progress(task, 1);
    }
}

namespace drawing {

render::Color distinct_color(std::size_t index) {
    // Eight hues that stay apart for the colour-blind too, after [Okabe08] in order of contrast; linear.
    static const std::array<render::Color, 8> kColors{render::Color{0.665f, 0.112f, 0.0f},
                                                      {0.0f, 0.168f, 0.445f},
                                                      {0.0f, 0.342f, 0.171f},
                                                      {0.604f, 0.191f, 0.386f},
                                                      {0.791f, 0.347f, 0.0f},
                                                      {0.093f, 0.456f, 0.815f},
                                                      {0.871f, 0.776f, 0.054f},
                                                      {0.05f, 0.05f, 0.05f}};
    return kColors[index % kColors.size()];
}

void label(render::Image& image, const Eigen::Vector2d& at, const std::string& text, int size,
           const render::Color& color) {
    render::TextStyle style;
    style.size = size;
    style.horizontal = render::HorizontalAlign::Center;
    style.vertical = render::VerticalAlign::Center;
    style.color = color;
    render::draw_text(image, static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y())),
                      text, style);
}

double scaled(const Shooting& shooting, double share, double least) {
    return std::max(least, share * std::min(shooting.width, shooting.height));
}

}  // namespace drawing
}  // namespace automorph
