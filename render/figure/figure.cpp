#include "render/figure/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "morph/frame_check.h"
#include "morph/mesh/errors.h"
#include "render/figure/drawn_figure.h"
#include "render/figure/frames.h"
#include "render/figure/mesh_source.h"
#include "render/figure/page.h"
#include "render/figure/sheet.h"
#include "render/figure/stopwatch.h"
#include "render/figure/subject.h"
#include "render/figure/text_file.h"
#include "render/image/image_file.h"

namespace automorph {
namespace {

void tell(const Progress& progress, const std::string& task, double fraction) {
    if (progress) progress(task, fraction);
}

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

/// Computes each different morph once, of rows that are not selected too, as the camera is theirs as well.
void compute_rows(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const Stopwatch loading;
    tell(options.progress, "meshes", 0);
    const InputMesh source = make_mesh(config.source, "source"), target = make_mesh(config.target, "target");
    tell(options.progress, "meshes", 1);
    figure.load_seconds = loading.seconds();

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
        tell(options.progress, task, 0);
        row.motion = {
            std::make_shared<const Morph>(morph(source, target, row.config.morph_options(config.seed))),
            row.config.interpolation};
        row.morph = figure.morphs.size();
        figure.morphs.push_back(row.motion.morph->report());
        tell(options.progress, task, 1);
    }
    for (const FigureRow& row : figure.rows) figure.motions.push_back(row.motion);
    figure.morph_seconds = morphing.seconds();
}

void check_rows(const FigureOptions& options, Figure& figure) {
    if (!options.check_frames) return;
    const Stopwatch checking;
    const std::string task = "checking frames";
    std::size_t done = 0;
    for (FigureRow& row : figure.rows) {
        tell(options.progress, task, static_cast<double>(done++) / static_cast<double>(figure.rows.size()));
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
    tell(options.progress, task, 1);
    figure.check_seconds = checking.seconds();
}

void render_row(const FigureConfig& config, const Shooting& shooting, const FrameSequence& sequence,
                FigureRow& row) {
    const std::string task = fmt::format("pictures of row {} ({})", row.number + 1, row.config.label);
    const FigureOptions& options = shooting.options;
    Subject subject(shooting, sequence.frames.front(), sequence.triangles);
    double done = 0, count = 0;
    for (std::size_t i = 0; i < config.alphas.size(); ++i) count += options.cells.has(i);
    for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
        if (!options.cells.has(i)) continue;
        FigureCell cell = subject.shoot(sequence.frames[i], [&](double fraction) {
            // The row is done when the call returns with its last cell, not before.
            tell(options.progress, task, std::min((done + fraction) / count, 0.999));
        });
        ++done;
        cell.alpha = sequence.alphas[i];
        cell.column = i;
        cell.label = "\u03b1 = " + fraction_text(cell.alpha);
        row.cells.push_back(std::move(cell));
    }
    tell(options.progress, task, 1);
}

void render_morphs(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    compute_rows(config, options, figure);
    std::vector<FrameSequence> sequences;
    std::vector<const Points*> frames;
    for (const FigureRow& row : figure.rows)
        sequences.push_back(frames_of(*row.motion.morph, config.alphas, row.motion.scheme));
    for (const FrameSequence& sequence : sequences) {
        for (const Points& V : sequence.frames) frames.push_back(&V);
    }
    const Shooting shooting =
        shooting_of(config.picture, options, {figure.width, figure.height, figure.spp}, frames);
    figure.camera = shooting.camera;
    std::vector<FigureRow> selected;
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        if (options.rows.has(i)) selected.push_back(std::move(figure.rows[i]));
    }
    figure.rows = std::move(selected);
    check_rows(options, figure);
    for (FigureRow& row : figure.rows) render_row(config, shooting, sequences[row.number], row);
}

/// How many rows and columns a figure has before anything is selected.
std::size_t row_count(const FigureConfig& config) {
    return std::max<std::size_t>(1, config.rows.size());
}

std::size_t column_count(const FigureConfig& config) {
    if (config.show == Show::Morph) return config.alphas.size();
    if (config.show == Show::Shape) return config.turns.size();
    return std::numeric_limits<std::size_t>::max();  // told by those who draw them
}

render::Metadata sheet_metadata(const FigureConfig& config) {
    return {{"Software", "automorph " AUTOMORPH_VERSION},
            {"config", config.file.filename().string()},
            {"config_hash", config_hash(config)}};
}

render::Metadata metadata(const FigureConfig& config, const Figure& figure, const FigureRow& row,
                          const FigureCell& cell) {
    render::Metadata about = sheet_metadata(config);
    about["row"] = row.config.label;
    about["cell"] = cell.label;
    about["spp"] = std::to_string(figure.spp);
    about["seed"] = std::to_string(config.picture.seed);
    return about;
}

}  // namespace

Figure render_figure(const FigureConfig& config, const FigureOptions& options) {
    Figure figure;
    figure.width = std::max(1, static_cast<int>(std::lround(config.picture.width * options.scale)));
    figure.height = std::max(1, static_cast<int>(std::lround(config.picture.height * options.scale)));
    figure.spp = options.spp.value_or(config.picture.spp);
    if (figure.spp < 1)
        throw ConfigError(fmt::format("{} samples per pixel: expected at least 1", figure.spp));

    options.rows.check(row_count(config), "row");
    options.cells.check(column_count(config), "cell");

    const Stopwatch whole;
    if (config.show == Show::Morph) {
        render_morphs(config, options, figure);
    } else {
        draw_figure(config, options, figure);
    }
    figure.render_seconds =
        whole.seconds() - figure.load_seconds - figure.morph_seconds - figure.check_seconds;
    return figure;
}

render::Image figure_sheet(const FigureConfig& config, const Figure& figure) {
    SheetText text;
    text.title = config.title;
    std::vector<std::vector<render::Image>> cells;
    for (const FigureRow& row : figure.rows) {
        text.rows.push_back(row.config.label);
        cells.emplace_back();
        for (const FigureCell& cell : row.cells) cells.back().push_back(cell.image);
    }
    for (const FigureCell& cell : figure.rows.front().cells) text.columns.push_back(cell.label);
    return make_sheet(cells, text, {config.picture.margin, config.picture.background.cast<float>().array()});
}

std::string cell_name(std::size_t row, std::size_t column) {
    return fmt::format("row{}-col{}", row + 1, column + 1);
}

void write_figure(const FigureConfig& config, const Figure& figure, const std::filesystem::path& folder) {
    make_folder(folder);
    for (const FigureRow& row : figure.rows) {
        for (const FigureCell& cell : row.cells) {
            render::Metadata about = metadata(config, figure, row, cell);
            const std::string name = cell_name(row.number, cell.column);
            about["color_space"] = "linear, primaries of Rec. 709";
            render::write_exr(folder / (name + ".exr"), cell.image, about);
            about["color_space"] = "sRGB";
            render::write_png(folder / (name + ".png"), cell.image, about);
        }
    }
    render::write_png(folder / "sheet.png", figure_sheet(config, figure), sheet_metadata(config));
    write_text_file(folder / "metrics.json", metrics_json(config, figure));
    write_text_file(folder / "index.html", page_html(config, figure));
}

}  // namespace automorph
