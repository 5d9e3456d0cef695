#include "render/figure/drawn_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "morph/report_of.h"
#include "render/figure/mesh_source.h"
#include "render/figure/panels.h"
#include "render/figure/picture_progress.h"
#include "render/figure/stopwatch.h"

namespace automorph {
namespace {

Film film_of(const Figure& figure) {
    return {figure.width, figure.height, figure.spp};
}

void draw_map(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const Stopwatch loading;
    const InputMesh shape = make_mesh(config.source, "source");
    figure.load_seconds = loading.seconds();
    const Stopwatch mapping;
    const ShapeMap map = map_shape(shape);
    figure.morph_seconds = mapping.seconds();
    const Shooting shooting = shooting_of(config.picture, options, film_of(figure), {&shape.mesh.V});
    Report& report = figure.morphs.emplace_back();
    report.source = shape.report;
    report.maps = {map.report};
    figure.rows.emplace_back().cells = map_panels(shooting, shape, map);
    figure.camera = shooting.camera;
}

void picture_shape(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const Stopwatch loading;
    const InputMesh shape = make_mesh(config.source, "source");
    figure.load_seconds = loading.seconds();
    std::vector<Points> sides;
    std::vector<const Points*> frames;
    const Points& V = shape.mesh.V;
    const Eigen::RowVector3d centre = 0.5 * (V.colwise().minCoeff() + V.colwise().maxCoeff());
    for (const double degrees : config.turns) sides.push_back(turned(V, centre, config.picture.up, degrees));
    for (const Points& side : sides) frames.push_back(&side);
    const Shooting shooting = shooting_of(config.picture, options, film_of(figure), frames);
    figure.camera = shooting.camera;
    figure.morphs.emplace_back().source = shape.report;
    FigureRow& row = figure.rows.emplace_back();
    Subject subject(shooting, shape.mesh.V, shape.mesh.F);
    std::size_t count = 0;
    for (std::size_t i = 0; i < sides.size(); ++i) count += options.cells.has(i);
    PictureProgress progress(options.progress, "pictures", "cell", count);
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (!options.cells.has(i)) continue;
        FigureCell cell = subject.shoot(sides[i], progress.begin(i + 1, shooting.samples()));
        progress.end(cell.samples, cell.rays);
        cell.label = fmt::format("{}\u00b0", config.turns[i]);
        cell.column = i;
        row.cells.push_back(std::move(cell));
    }
    progress.finish();
}

std::vector<FigureCell> draw_borders(const Shooting& shooting, const InputMesh& source,
                                     const InputMesh& target, std::uint64_t seed, Report& report) {
    const BorderInsertion insertion = insert_borders(source, target, seed);
    report.source = source.report;
    report.target = target.report;
    report.registration = insertion.registration;
    report.border = report_of(insertion.border);
    return border_panels(shooting, insertion);
}

/// A row per set of features; the shapes are pictured once.
void draw_features(const FigureConfig& config, const Shooting& shooting, const InputMesh& source,
                   const InputMesh& target, Figure& figure) {
    const FigureOptions& options = shooting.options;
    const PicturedShape pictured_source(shooting, source.mesh), pictured_target(shooting, target.mesh);
    for (std::size_t i = 0; i < config.rows.size(); ++i) {
        if (!options.rows.has(i)) continue;
        FigureRow& row = figure.rows.emplace_back();
        row.config = config.rows[i];
        row.number = i;
        row.morph = figure.morphs.size();
        const std::string task = fmt::format("row {} ({})", i + 1, row.config.label);
        options.progress(task, 0);
        RowConfig by_features = row.config;
        by_features.alignment = Alignment::Features;
        const Report& report = figure.morphs.emplace_back(
            morph(source, target, by_features.morph_options(config.seed)).report());
        row.cells = feature_panels(shooting, pictured_source, pictured_target, report.features);
        options.progress(task, 1);
    }
}

void draw_panels(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    if (config.show == Show::Map) return draw_map(config, options, figure);
    const Stopwatch loading;
    const InputMesh source = make_mesh(config.source, "source"), target = make_mesh(config.target, "target");
    figure.load_seconds = loading.seconds();
    const Shooting shooting =
        shooting_of(config.picture, options, film_of(figure), {&source.mesh.V, &target.mesh.V});
    figure.camera = shooting.camera;
    if (config.show == Show::Features) return draw_features(config, shooting, source, target, figure);
    figure.rows.emplace_back().cells =
        draw_borders(shooting, source, target, config.seed, figure.morphs.emplace_back());
}

/// Panels are drawn together; those not selected are left out afterwards.
void select_panels(const Selection& selection, FigureRow& row) {
    std::vector<FigureCell> all;
    all.swap(row.cells);
    for (std::size_t i = 0; i < all.size(); ++i) {
        all[i].column = i;
        if (selection.has(i)) row.cells.push_back(std::move(all[i]));
    }
}

}  // namespace

void draw_figure(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    if (config.show == Show::Shape) return picture_shape(config, options, figure);
    draw_panels(config, options, figure);
    for (FigureRow& row : figure.rows) select_panels(options.cells, row);
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
