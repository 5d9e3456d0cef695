#include <nlohmann/json.hpp>

#include "render/figure/figure.h"
#include "render/figure/names.h"

namespace automorph {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

Json row_json(const FigureRow& row, std::size_t index) {
    Json cells = Json::array();
    for (std::size_t j = 0; j < row.cells.size(); ++j) {
        const FigureCell& cell = row.cells[j];
        cells.push_back({{"name", cell_name(index, j)},
                         {"alpha", cell.alpha},
                         {"render_seconds", cell.seconds},
                         {"rays", cell.rays},
                         {"bad_samples", cell.bad_samples}});
    }
    return {{"label", row.config.label},
            {"alignment", name_of(kAlignments, row.config.alignment)},
            {"interpolation", name_of(kInterpolations, row.config.interpolation)},
            {"openings", name_of(kOpenings, row.config.openings)},
            {"domain", name_of(kDomains, row.config.domain)},
            {"lift", row.config.lift},
            {"morph", row.morph},
            {"cells", cells}};
}

}  // namespace

std::string metrics_json(const FigureConfig& config, const Figure& figure) {
    Json json;
    json["title"] = config.title;
    json["config"] = config.file.string();
    json["config_text"] = config.text;
    json["picture"] = {{"width", figure.width},
                       {"height", figure.height},
                       {"spp", figure.spp},
                       {"seed", config.picture.seed}};
    json["camera"] = {{"position", vector_json(figure.camera.position)},
                      {"target", vector_json(figure.camera.target)},
                      {"up", vector_json(figure.camera.up)},
                      {"vertical_fov_degrees", figure.camera.vertical_fov}};
    json["rows"] = Json::array();
    for (std::size_t i = 0; i < figure.rows.size(); ++i) json["rows"].push_back(row_json(figure.rows[i], i));
    json["morphs"] = Json::array();
    for (const Report& report : figure.morphs) json["morphs"].push_back(Json::parse(report_json(report)));
    json["seconds"] = {
        {"load", figure.load_seconds}, {"morph", figure.morph_seconds}, {"render", figure.render_seconds}};
    // Labels come from files, which may hold anything: what is not UTF-8 is replaced, never an error.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace automorph
