#include "render/figure/page.h"

#include <nlohmann/json.hpp>
#include <string_view>

#include "render/figure/legend.h"
#include "render/figure/page_files.h"
#include "render/image/image_file.h"

namespace automorph {
namespace {

using Json = nlohmann::ordered_json;
using render::Image;

constexpr int kWidestCell = 640;  // pixels; wider cells are shown smaller, and lie beside the page in full
constexpr int kQuality = 90;      // of JPEG

/// Half the size, each pixel the mean of four.
Image halved(const Image& image) {
    Image half(image.width / 2, image.height / 2, image.channels);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                half.at(x, y)[c] =
                    0.25f * (image.at(2 * x, 2 * y)[c] + image.at(2 * x + 1, 2 * y)[c] +
                             image.at(2 * x, 2 * y + 1)[c] + image.at(2 * x + 1, 2 * y + 1)[c]);
            }
        }
    }
    return half;
}

Image shown(Image image) {
    while (image.width > kWidestCell && image.height > 1) image = halved(image);
    return image;
}

/// What the slider moves through: the video's stills, or else the cells.
Json motion_json(const FigureRow& row, const Json& cells) {
    if (row.clip && !row.clip->stills.empty()) {
        return {{"width", row.clip->width},
                {"height", row.clip->height},
                {"alphas", row.clip->alphas},
                {"stills", row.clip->stills}};
    }
    Json motion = {{"width", cells[0]["width"]}, {"height", cells[0]["height"]}};
    motion["alphas"] = motion["stills"] = Json::array();
    for (const Json& cell : cells) {
        motion["alphas"].push_back(cell["alpha"]);
        motion["stills"].push_back(cell["image"]);
    }
    return motion;
}

Json picture_json(const FigureCell& cell) {
    const Image image = shown(cell.image);
    return {{"label", cell.label},
            {"width", image.width},
            {"height", image.height},
            {"image", render::jpeg_data_uri(image, kQuality)}};
}

Json pictures_json(const std::vector<FigureCell>& cells) {
    Json pictures = Json::array();
    for (const FigureCell& cell : cells) pictures.push_back(picture_json(cell));
    return pictures;
}

/// Drawn twice as large as it is shown, for sharp screens.
Json legend_json(const ColorScale& scale) {
    constexpr int kBar = 480, kText = 26;
    const Image image = make_legend(scale, kBar, kText);
    return {{"meaning", scale.meaning},   {"low", scale.low},
            {"high", scale.high},         {"width", image.width / 2},
            {"height", image.height / 2}, {"image", render::jpeg_data_uri(image, kQuality)}};
}

/// The metrics, with the pictures.
Json page_data(const FigureConfig& config, const Figure& figure) {
    Json data = Json::parse(metrics_json(config, figure));
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        const FigureRow& row = figure.rows[i];
        Json& row_data = data["rows"][i];
        for (std::size_t j = 0; j < row.cells.size(); ++j) {
            row_data["cells"][j].update(picture_json(row.cells[j]));
        }
        if (row.clip) row_data["video"]["films"] = row.clip->films;
        row_data["motion"] = row.motion.morph ? motion_json(row, row_data["cells"]) : Json();
    }
    for (std::size_t i = 0; i < figure.panels.size(); ++i) {
        data["morphs"][i]["map_pictures"] = pictures_json(figure.panels[i].maps);
        data["morphs"][i]["feature_pictures"] = pictures_json(figure.panels[i].features);
    }
    if (figure.turntable) data["turntable"]["films"] = figure.turntable->films;
    if (figure.scale) data["legend"] = legend_json(*figure.scale);
    data["no_videos"] = figure.no_videos;
    return data;
}

/// Text with what means something in HTML replaced by `name(c)`.
template <class Name>
std::string escaped(const std::string& text, const Name& name) {
    std::string result;
    result.reserve(text.size());
    for (const char c : text) {
        if (c == '<' || c == '>' || c == '&' || c == '"' || c == '\'') {
            result += name(c);
        } else {
            result += c;
        }
    }
    return result;
}

std::string html_text(const std::string& text) {
    return escaped(text, [](char c) { return "&#" + std::to_string(static_cast<int>(c)) + ";"; });
}

/// JSON inside a script element: no tag can end it, whatever a config holds.
std::string script_data(const Json& data) {
    const std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace);
    return escaped(text, [](char c) -> std::string {
        if (c == '<') return "\\u003c";
        if (c == '>') return "\\u003e";
        return c == '&' ? "\\u0026" : std::string(1, c);
    });
}

}  // namespace

std::string page_html(const FigureConfig& config, const Figure& figure) {
    const std::string_view page = page::kHtml;
    const auto part = [&](std::string_view name) -> std::string {
        if (name == "title")
            return html_text(config.title.empty() ? config.file.filename().string() : config.title);
        if (name == "style") return page::kStyle;
        if (name == "script") return page::kScript;
        return script_data(page_data(config, figure));
    };
    std::string html;
    std::size_t begin = 0;
    for (std::size_t open; (open = page.find("{{", begin)) != page.npos;) {
        const std::size_t close = page.find("}}", open);
        html += page.substr(begin, open - begin);
        html += part(page.substr(open + 2, close - open - 2));
        begin = close + 2;
    }
    return html += page.substr(begin);
}

}  // namespace automorph
