#include "morph/report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace automorph {

namespace {

using Json = nlohmann::ordered_json;

Json json(const MeshReport& mesh) {
    return {{"name", mesh.name},           {"vertices", mesh.vertices},
            {"triangles", mesh.triangles}, {"boundary_loops", mesh.boundary_loops},
            {"closed", mesh.closed},       {"mended", mesh.mended}};
}

Json json(const RegistrationReport& registration) {
    return {{"used", registration.used},
            {"rotation", registration.rotation},
            {"translation", registration.translation},
            {"scale", registration.scale},
            {"sigma", registration.sigma},
            {"residual", registration.residual},
            {"runner_up", registration.runner_up},
            {"iterations", registration.iterations},
            {"converged", registration.converged},
            {"confident", registration.confident}};
}

Json json(const AlignmentReport& alignment) {
    Json limb_matches = Json::array();
    for (const auto& [source, target] : alignment.limb_matches)
        limb_matches.push_back({{"source", source}, {"target", target}});
    return {{"used", alignment.used},
            {"distance", alignment.distance},
            {"flipped_before", alignment.flipped_before},
            {"moved", alignment.moved},
            {"rounds", alignment.rounds},
            {"limbs_source", alignment.limbs_source},
            {"limbs_target", alignment.limbs_target},
            {"limb_matches", limb_matches}};
}

Json json(const DistortionReport& distortion) {
    return {{"median", distortion.median}, {"p95", distortion.p95}, {"worst", distortion.worst}};
}

Json json(const MapReport& map) {
    return {{"of", map.of},
            {"weights", map.weights},
            {"reason", map.reason},
            {"flipped", map.flipped},
            {"p01", map.p01},
            {"smallest_ratio", map.smallest_ratio},
            {"residual", map.residual},
            {"area_distortion", json(map.area)},
            {"angle_distortion", json(map.angle)}};
}

Json json(const BorderReport& border) {
    return {{"source", border.source},
            {"target", border.target},
            {"shared", border.shared},
            {"merged", border.merged}};
}

Json json(const FeatureReport& features) {
    Json matches = Json::array();
    for (const FeatureReport::Match& match : features.matches) {
        matches.push_back(
            {{"source", match.source}, {"target", match.target}, {"difference", match.difference}});
    }
    return {{"candidates_source", features.candidates_source},
            {"candidates_target", features.candidates_target},
            {"matches", matches},
            {"in_place", features.in_place},
            {"warps", features.warps},
            {"rounds", features.rounds},
            {"distance_before", features.distance_before},
            {"distance_after", features.distance_after}};
}

Json json(const OverlayReport& overlay) {
    return {{"vertices_a", overlay.vertices_a},   {"vertices_b", overlay.vertices_b},
            {"crossings", overlay.crossings},     {"coincident", overlay.coincident},
            {"snapped", overlay.snapped},         {"on_edges", overlay.on_edges},
            {"vertices", overlay.vertices},       {"triangles", overlay.triangles},
            {"zero_area_a", overlay.zero_area_a}, {"zero_area_b", overlay.zero_area_b},
            {"turned_a", overlay.turned_a},       {"turned_b", overlay.turned_b},
            {"flattened_a", overlay.flattened_a}, {"flattened_b", overlay.flattened_b}};
}

Json json(const SphereAlignmentReport& alignment) {
    return {{"matches", alignment.matches},
            {"before", alignment.before},
            {"rotated", alignment.rotated},
            {"after", alignment.after}};
}

Json json(const FrameReport& frame) {
    return {{"alpha", frame.alpha},
            {"reversed", frame.reversed},
            {"self_intersecting", frame.self_intersecting},
            {"self_intersecting_estimated", frame.self_intersecting_estimated},
            {"area", frame.area},
            {"volume", frame.volume},
            {"area_ratio", frame.area_ratio},
            {"volume_ratio", frame.volume_ratio},
            {"smallest_angle", frame.smallest_angle}};
}

Json json(const StageReport& stage) {
    return {{"name", stage.name}, {"seconds", stage.seconds}, {"peak_memory_mb", stage.peak_memory_mb}};
}

template <typename T>
Json json(const std::vector<T>& list) {
    Json result = Json::array();
    for (const T& item : list) result.push_back(json(item));
    return result;
}

}  // namespace

std::string doubt_about(const RegistrationReport& registration) {
    if (registration.confident) return "";
    if (registration.runner_up < registration.residual) {
        return fmt::format(
            "another pose fits a little better (residual {:.4f} against {:.4f}), but among poses that close "
            "the "
            "one that turns the source least is taken",
            registration.runner_up, registration.residual);
    }
    return fmt::format("another pose fits nearly as well (residual {:.4f} against {:.4f} of the one taken)",
                       registration.runner_up, registration.residual);
}

std::string report_json(const Report& report) {
    const Json root = {{"source", json(report.source)},
                       {"target", json(report.target)},
                       {"registration", json(report.registration)},
                       {"alignment", json(report.alignment)},
                       {"domain", report.domain},
                       {"sphere_alignment", json(report.sphere_alignment)},
                       {"border", json(report.border)},
                       {"target_reversed", report.target_reversed},
                       {"maps", json(report.maps)},
                       {"features", json(report.features)},
                       {"overlays", json(report.overlays)},
                       {"reopened_triangles", report.reopened_triangles},
                       {"notes", report.notes},
                       {"stages", json(report.stages)},
                       {"frames", json(report.frames)}};
    return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace automorph
