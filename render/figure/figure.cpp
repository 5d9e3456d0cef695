#include "render/figure/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "morph/mesh/errors.h"
#include "render/figure/drawn_figure.h"
#include "render/figure/frames.h"
#include "render/figure/mesh_source.h"
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

/// Computes each different morph once and fills in morphs and rows; returns the frames of each row.
std::vector<FrameSequence> compute_rows(const FigureConfig& config, const FigureOptions& options,
                                        Figure& figure) {
    Stopwatch loading;
    tell(options.progress, "meshes", 0);
    const InputMesh source = make_mesh(config.source, "source"), target = make_mesh(config.target, "target");
    tell(options.progress, "meshes", 1);
    figure.load_seconds = loading.seconds();

    Stopwatch morphing;
    std::vector<FrameSequence> sequences(config.rows.size());
    for (const RowConfig& row : config.rows) figure.rows.push_back({row, 0, {}});
    std::vector<bool> done(config.rows.size(), false);
    for (std::size_t first = 0; first < config.rows.size(); ++first) {
        if (done[first]) continue;
        const RowConfig& row = config.rows[first];
        const std::string task = fmt::format("morph of row {} ({})", first + 1, row.label);
        tell(options.progress, task, 0);
        const Morph result = morph(source, target, row.morph_options(config.seed));
        for (std::size_t i = first; i < config.rows.size(); ++i) {
            if (!same_morph(row, config.rows[i])) continue;
            sequences[i] = frames_of(result, config.alphas, config.rows[i].interpolation);
            figure.rows[i].morph = figure.morphs.size();
            done[i] = true;
        }
        figure.morphs.push_back(result.report());
        tell(options.progress, task, 1);
    }
    figure.morph_seconds = morphing.seconds();
    return sequences;
}

void render_row(const Shooting& shooting, const FrameSequence& sequence, FigureRow& row,
                const std::string& task) {
    Subject subject(shooting, sequence.frames.front(), sequence.triangles);
    for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
        const double before = static_cast<double>(i), count = static_cast<double>(sequence.frames.size());
        FigureCell cell = subject.shoot(sequence.frames[i], [&](double fraction) {
            // The row is done when the call returns with its last cell, not before.
            tell(shooting.options.progress, task, std::min((before + fraction) / count, 0.999));
        });
        cell.alpha = sequence.alphas[i];
        cell.label = "\u03b1 = " + fraction_text(cell.alpha);
        row.cells.push_back(std::move(cell));
    }
    tell(shooting.options.progress, task, 1);
}

void render_morphs(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const std::vector<FrameSequence> sequences = compute_rows(config, options, figure);
    std::vector<const Points*> frames;
    for (const FrameSequence& sequence : sequences) {
        for (const Points& V : sequence.frames) frames.push_back(&V);
    }
    const Shooting shooting = shooting_of(config.picture, options, figure, frames);
    figure.camera = shooting.camera;
    for (std::size_t i = 0; i < sequences.size(); ++i) {
        const std::string task = fmt::format("pictures of row {} ({})", i + 1, config.rows[i].label);
        render_row(shooting, sequences[i], figure.rows[i], task);
    }
}

render::Metadata metadata(const FigureConfig& config, const Figure& figure, const FigureRow& row,
                          const FigureCell& cell) {
    return {{"Software", "automorph"},           {"config", config.file.filename().string()},
            {"row", row.config.label},           {"cell", cell.label},
            {"spp", std::to_string(figure.spp)}, {"seed", std::to_string(config.picture.seed)}};
}

}  // namespace

Figure render_figure(const FigureConfig& config, const FigureOptions& options) {
    Figure figure;
    figure.width = std::max(1, static_cast<int>(std::lround(config.picture.width * options.scale)));
    figure.height = std::max(1, static_cast<int>(std::lround(config.picture.height * options.scale)));
    figure.spp = options.spp.value_or(config.picture.spp);
    if (figure.spp < 1)
        throw ConfigError(fmt::format("{} samples per pixel: expected at least 1", figure.spp));

    Stopwatch whole;
    if (config.show == Show::Morph) {
        render_morphs(config, options, figure);
    } else {
        draw_figure(config, options, figure);
    }
    figure.render_seconds = whole.seconds() - figure.load_seconds - figure.morph_seconds;
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
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        const FigureRow& row = figure.rows[i];
        for (std::size_t j = 0; j < row.cells.size(); ++j) {
            const render::Metadata about = metadata(config, figure, row, row.cells[j]);
            const std::filesystem::path exr = folder / (cell_name(i, j) + ".exr");
            if (row.cells[j].layers) {
                render::write_exr(exr, row.cells[j].image, *row.cells[j].layers, about);
            } else {
                render::write_exr(exr, row.cells[j].image, about);
            }
            render::write_png(folder / (cell_name(i, j) + ".png"), row.cells[j].image, about);
        }
    }
    render::write_png(folder / "sheet.png", figure_sheet(config, figure),
                      {{"Software", "automorph"}, {"config", config.file.filename().string()}});
    write_text_file(folder / "metrics.json", metrics_json(config, figure));
}

}  // namespace automorph
