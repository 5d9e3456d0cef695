#include <nlohmann/json.hpp>

#include "render/figure/figure.h"
#include "render/figure/names.h"

namespace automorph {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

Json frame_json(const FrameReport& frame) {
    return {{"alpha", frame.alpha},
            {"area", frame.area},
            {"volume", frame.volume},
            {"area_ratio", frame.area_ratio},
            {"volume_ratio", frame.volume_ratio},
            {"smallest_angle_degrees", frame.smallest_angle},
            {"reversed_triangles", frame.reversed},
            {"self_intersecting_triangles", frame.self_intersecting},
            {"self_intersecting_estimated", frame.self_intersecting_estimated}};
}

Json clip_json(const Clip& clip) {
    Json files = Json::array();
    if (clip.encoded) files = {clip.name + ".mp4", clip.name + ".webm"};
    return {{"files", files},
            {"frames", clip.frames},
            {"width", clip.width},
            {"height", clip.height},
            {"render_seconds", clip.seconds}};
}

Json row_json(const FigureRow& row) {
    Json cells = Json::array(), frames = Json::array();
    for (const FigureCell& cell : row.cells) {
        cells.push_back({{"name", cell_name(row.number, cell.column)},
                         {"alpha", cell.alpha},
                         {"render_seconds", cell.seconds},
                         {"rays", cell.rays},
                         {"bad_samples", cell.bad_samples}});
    }
    for (const FrameReport& frame : row.frames) frames.push_back(frame_json(frame));
    return {{"label", row.config.label},
            {"alignment", name_of(kAlignments, row.config.alignment)},
            {"interpolation", name_of(kInterpolations, row.config.interpolation)},
            {"openings", name_of(kOpenings, row.config.openings)},
            {"domain", name_of(kDomains, row.config.domain)},
            {"lift", row.config.lift},
            {"morph", row.morph},
            {"cells", cells},
            {"frames", frames},
            {"warnings", row.warnings},
            {"video", row.clip ? clip_json(*row.clip) : Json()}};
}

}  // namespace

std::string metrics_json(const FigureConfig& config, const Figure& figure) {
    Json json;
    json["title"] = config.title;
    json["version"] = AUTOMORPH_VERSION;
    json["config"] = config.file.string();
    json["config_hash"] = config_hash(config);
    json["config_text"] = config.text;
    json["extends"] = Json::array();
    for (const ConfigText& base : config.bases)
        json["extends"].push_back({{"config", base.file.string()}, {"config_text", base.text}});
    json["overrides"] = config.overrides;
    json["part"] = figure.part;
    json["show"] = name_of(kShows, config.show);
    json["picture"] = {{"width", figure.width},
                       {"height", figure.height},
                       {"spp", figure.spp},
                       {"seed", config.picture.seed}};
    json["camera"] = {{"position", vector_json(figure.camera.position)},
                      {"target", vector_json(figure.camera.target)},
                      {"up", vector_json(figure.camera.up)},
                      {"vertical_fov_degrees", figure.camera.vertical_fov}};
    json["rows"] = Json::array();
    for (const FigureRow& row : figure.rows) json["rows"].push_back(row_json(row));
    json["morphs"] = Json::array();
    for (const Report& report : figure.morphs) json["morphs"].push_back(Json::parse(report_json(report)));
    json["turntable"] = figure.turntable ? clip_json(*figure.turntable) : Json();
    json["seconds"] = {{"load", figure.load_seconds},     {"morph", figure.morph_seconds},
                       {"check", figure.check_seconds},   {"panels", figure.panel_seconds},
                       {"render", figure.render_seconds}, {"video", figure.video_seconds}};
    // Labels come from files, which may hold anything: what is not UTF-8 is replaced, never an error.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace automorph
