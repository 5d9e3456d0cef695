#include "render/figure/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "morph/frame_check.h"
#include "morph/mesh/errors.h"
#include "render/figure/drawn_figure.h"
#include "render/figure/frames.h"
#include "render/figure/looks.h"
#include "render/figure/mesh_source.h"
#include "render/figure/morph_panels.h"
#include "render/figure/picture_progress.h"
#include "render/figure/row_subject.h"
#include "render/figure/sheet.h"
#include "render/figure/stopwatch.h"

namespace automorph {
namespace {

/// Rows with the same options share their morph.
bool same_morph(const RowConfig& a, const RowConfig& b) {
    return a.alignment == b.alignment && a.openings == b.openings && a.domain == b.domain &&
           a.lift == b.lift && a.features == b.features && a.nonrigid == b.nonrigid;
}

/// The row's motion looked at, as `automorph morph --report` does.
void check_frames_of(FigureRow& row, const Report& morph_report) {
    const Report report = report_with_frames(*row.motion.morph, row.motion.scheme);
    row.frames = report.frames;
    row.warnings.assign(report.notes.begin() + static_cast<std::ptrdiff_t>(morph_report.notes.size()),
                        report.notes.end());
}

/// What a row shows.
struct RowFrames {
    FrameSequence sequence;
    std::vector<Eigen::VectorXd> numbers;  ///< of each frame, if it is coloured by them
};

ShapePair load_shapes(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const Stopwatch loading;
    options.progress("meshes", 0);
    ShapePair shapes{make_mesh(config.source, "source"), make_mesh(config.target, "target")};
    options.progress("meshes", 1);
    figure.load_seconds = loading.seconds();
    return shapes;
}

/// Computes each different morph once, of rows that are not selected too, as the camera is theirs as well.
/// Returns what each row shows.
std::vector<RowFrames> compute_rows(const FigureConfig& config, const FigureOptions& options,
                                    const ShapePair& shapes, Figure& figure) {
    const Stopwatch morphing;
    for (std::size_t i = 0; i < config.rows.size(); ++i) {
        FigureRow& row = figure.rows.emplace_back();
        row.config = config.rows[i];
        row.number = i;
        const auto same =
            std::find_if(figure.rows.begin(), figure.rows.end() - 1,
                         [&](const FigureRow& other) { return same_morph(other.config, row.config); });
        if (same != figure.rows.end() - 1) {
            row.motion = {same->motion.morph, row.config.interpolation};
            row.morph = same->morph;
            continue;
        }
        const std::string task = fmt::format("morph of row {} ({})", i + 1, row.config.label);
        options.progress(task, 0);
        MorphOptions morph_options = row.config.morph_options(config.seed);
        morph_options.keep_maps = options.panels;
        row.motion = {std::make_shared<const Morph>(morph(shapes.source, shapes.target, morph_options)),
                      row.config.interpolation};
        row.morph = figure.morphs.size();
        figure.morphs.push_back(row.motion.morph->report());
        options.progress(task, 1);
    }
    for (const FigureRow& row : figure.rows) figure.motions.push_back(row.motion);
    figure.morph_seconds = morphing.seconds();
    std::vector<RowFrames> rows;
    for (FigureRow& row : figure.rows) {
        const Morph& morph = *row.motion.morph;
        row.marked = marked_vertices(config.picture.markers, shapes.source.mesh.V, morph.endpoints().a,
                                     morph.report().features);
        RowFrames& shown = rows.emplace_back();
        shown.sequence = frames_of(morph, config.alphas, row.motion.scheme);
        if (config.picture.color != ColorField::None)
            shown.numbers = color_field(config.picture.color, shown.sequence);
    }
    return rows;
}

void check_rows(const FigureOptions& options, Figure& figure) {
    if (!options.check_frames) return;
    const Stopwatch checking;
    const std::string task = "checking frames";
    std::size_t done = 0;
    for (FigureRow& row : figure.rows) {
        options.progress(task, static_cast<double>(done++) / static_cast<double>(figure.rows.size()));
        const auto same = std::find_if(figure.rows.begin(), figure.rows.end(), [&](const FigureRow& other) {
            return !other.frames.empty() && other.morph == row.morph &&
                   other.config.interpolation == row.config.interpolation;
        });
        if (same != figure.rows.end()) {
            row.frames = same->frames;
            row.warnings = same->warnings;
        } else {
            check_frames_of(row, figure.morphs[row.morph]);
        }
    }
    options.progress(task, 1);
    figure.check_seconds = checking.seconds();
}

/// Draws what the selected rows' morphs are made of.
void draw_panels(const FigureConfig& config, const FigureOptions& options, const ShapePair& shapes,
                 Figure& figure) {
    if (!options.panels) return;
    const Stopwatch drawing;
    const std::string task = "maps and features";
    options.progress(task, 0);
    figure.panels.resize(figure.morphs.size());
    for (const FigureRow& row : figure.rows) {
        MorphPanels& panels = figure.panels[row.morph];
        if (panels.maps.empty())
            panels = morph_panels(config, options, figure.camera, shapes, *row.motion.morph);
    }
    options.progress(task, 1);
    figure.panel_seconds = drawing.seconds();
}

/// @param scale  of the numbers, if there are any
void render_row(const Shooting& shooting, const RowFrames& frames, const std::optional<ColorScale>& scale,
                FigureRow& row) {
    const FrameSequence& sequence = frames.sequence;
    const std::string task = fmt::format("pictures of row {} ({})", row.number + 1, row.config.label);
    const FigureOptions& options = shooting.options;
    RowSubject subject(shooting, row, scale);
    std::size_t count = 0;
    for (std::size_t i = 0; i < sequence.frames.size(); ++i) count += options.cells.has(i);
    PictureProgress progress(options.progress, task, "cell", count);
    for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
        if (!options.cells.has(i)) continue;
        subject.correct_normals({row.motion.shading(sequence.alphas[i])});
        FigureCell cell = subject.shoot({sequence.frames[i]}, scale ? frames.numbers[i] : Eigen::VectorXd(),
                                        progress.begin(i + 1, shooting.samples()));
        progress.end(cell.samples, cell.rays);
        cell.alpha = sequence.alphas[i];
        cell.column = i;
        cell.label = "\u03b1 = " + fraction_text(cell.alpha);
        row.cells.push_back(std::move(cell));
    }
    progress.finish();
}

void render_morphs(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const ShapePair shapes = load_shapes(config, options, figure);
    const std::vector<RowFrames> rows = compute_rows(config, options, shapes, figure);
    std::vector<const Points*> frames;
    std::vector<std::vector<Eigen::VectorXd>> numbers;
    for (const RowFrames& row : rows) {
        for (const Points& V : row.sequence.frames) frames.push_back(&V);
        numbers.push_back(row.numbers);
    }
    if (config.picture.color != ColorField::None) figure.scale = color_scale(config.picture.color, numbers);
    const Shooting shooting =
        shooting_of(config.picture, options, {figure.width, figure.height, figure.spp}, frames);
    figure.camera = shooting.camera;
    std::vector<FigureRow> selected;
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        if (options.rows.has(i)) selected.push_back(std::move(figure.rows[i]));
    }
    figure.rows = std::move(selected);
    check_rows(options, figure);
    draw_panels(config, options, shapes, figure);
    for (FigureRow& row : figure.rows) render_row(shooting, rows[row.number], figure.scale, row);
}

}  // namespace

FigureGrid figure_grid(const FigureConfig& config) {
    const std::size_t rows = std::max<std::size_t>(1, config.rows.size());
    switch (config.show) {
        case Show::Morph:
            return {rows, config.alphas.size()};
        case Show::Shape:
            return {1, config.turns.size()};
        case Show::Map:
            return {1, 2};
        case Show::Borders:
            return {1, 3};
        case Show::Features:
            return {rows, 2};
        case Show::Looks:
            return {std::max<std::size_t>(1, config.stages.size()), config.looks.size()};
    }
    return {};
}

std::string part_text(const FigureOptions& options) {
    std::string text;
    for (const auto& [name, selection] :
         {std::pair{"rows", &options.rows}, {"cells", &options.cells}, {"frames", &options.frames}}) {
        if (!selection->empty())
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name, selection->text());
    }
    return text;
}

void check_selections(const FigureConfig& config, const FigureOptions& options) {
    const FigureGrid grid = figure_grid(config);
    options.rows.check(grid.rows, "row");
    options.cells.check(grid.columns, "cell");
    const int frames = std::max(config.video.frames, config.video.turntable);
    if (config.show == Show::Morph && frames > 0)
        options.frames.check(static_cast<std::size_t>(frames), "frame");
}

Figure render_figure(const FigureConfig& config, const FigureOptions& options) {
    Figure figure;
    figure.width = std::max(1, static_cast<int>(std::lround(config.picture.width * options.scale)));
    figure.height = std::max(1, static_cast<int>(std::lround(config.picture.height * options.scale)));
    figure.spp = options.spp.value_or(config.picture.spp);
    if (figure.spp < 1)
        throw ConfigError(fmt::format("{} samples per pixel: expected at least 1", figure.spp));

    check_selections(config, options);
    figure.part = part_text(options);

    const Stopwatch whole;
    if (config.show == Show::Morph) {
        render_morphs(config, options, figure);
    } else if (config.show == Show::Looks) {
        picture_looks(config, options, figure);
    } else {
        draw_figure(config, options, figure);
    }
    figure.render_seconds = whole.seconds() - figure.load_seconds - figure.morph_seconds -
                            figure.check_seconds - figure.panel_seconds;
    return figure;
}

}  // namespace automorph
