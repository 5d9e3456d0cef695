#include <fmt/format.h>

#include <algorithm>

#include "morph/mesh/write_file.h"
#include "render/figure/figure.h"
#include "render/figure/page.h"
#include "render/figure/sheet.h"
#include "render/image/image_file.h"

namespace automorph {
namespace {

render::Metadata sheet_metadata(const FigureConfig& config) {
    return {{"Software", "automorph " AUTOMORPH_VERSION},
            {"config", config.file.filename().string()},
            {"config_hash", config_hash(config)}};
}

/// With the size in print: a cell is four centimetres wide, which gives labels eight points.
render::Metadata printed_sheet_metadata(const FigureConfig& config, const Figure& figure) {
    constexpr double kInch = 2.54, kCellWidth = 4.0;  // centimetres
    render::Metadata about = sheet_metadata(config);
    about["ResolutionUnit"] = "in";
    about["XResolution"] = about["YResolution"] = fmt::format("{:.1f}", kInch * figure.width / kCellWidth);
    return about;
}

/// Space between the cells of a sheet that do not merge, relative to their width.
constexpr double kGap = 0.02;

bool cells_end_in_background(const FigureConfig& config) {
    if (config.show != Show::Looks || config.stages.empty()) return config.picture.ends_in_background();
    return std::all_of(config.stages.begin(), config.stages.end(), [&](const StageConfig& stage) {
        return stage.picture.ends_in_background() && stage.picture.background == config.picture.background;
    });
}

/// What the sheet, written with the plain curve, shows as the cells' own files do.
render::Image toned(render::Image image, render::ToneCurve curve) {
    if (curve == render::ToneCurve::Filmic)
        std::transform(image.pixels.begin(), image.pixels.end(), image.pixels.begin(), render::filmic);
    return image;
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

render::Image figure_sheet(const FigureConfig& config, const Figure& figure) {
    SheetText text;
    text.title = config.title;
    std::vector<std::vector<render::Image>> cells;
    for (const FigureRow& row : figure.rows) {
        text.rows.push_back(row.config.label);
        cells.emplace_back();
        for (const FigureCell& cell : row.cells)
            cells.back().push_back(toned(cell.image, config.picture.curve));
    }
    for (const FigureCell& cell : figure.rows.front().cells) text.columns.push_back(cell.label);
    render::Color background = config.picture.background.cast<float>().array();
    if (config.picture.curve == render::ToneCurve::Filmic) background = background.unaryExpr(&render::filmic);
    SheetFade fade{config.picture.margin, background, kGap};
    if (cells_end_in_background(config)) {
        fade.gap = 0;
    } else {
        fade.margin = 0;
    }
    return make_sheet(cells, text, fade, figure.scale);
}

std::string cell_name(std::size_t row, std::size_t column) {
    return fmt::format("row{}-col{}", row + 1, column + 1);
}

void write_figure(const FigureConfig& config, const Figure& figure, const std::filesystem::path& folder) {
    make_folder(folder);
    const render::PngOptions png{config.picture.curve, config.picture.bits};
    for (const FigureRow& row : figure.rows) {
        for (const FigureCell& cell : row.cells) {
            render::Metadata about = metadata(config, figure, row, cell);
            const std::string name = cell_name(row.number, cell.column);
            about["color_space"] = "linear, primaries of Rec. 709";
            if (cell.layers) {
                render::write_exr(folder / (name + ".exr"), cell.image, *cell.layers, about);
            } else {
                render::write_exr(folder / (name + ".exr"), cell.image, about);
            }
            about["color_space"] = png.curve == render::ToneCurve::Filmic ? "sRGB, filmic" : "sRGB";
            render::write_png(folder / (name + ".png"), cell.image, about, png);
        }
    }
    render::write_png(folder / "sheet.png", figure_sheet(config, figure),
                      printed_sheet_metadata(config, figure), {render::ToneCurve::Srgb, config.picture.bits});
    write_file(folder / "metrics.json", metrics_json(config, figure));
    write_file(folder / "index.html", page_html(config, figure));
}

}  // namespace automorph
