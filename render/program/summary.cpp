#include "render/program/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace automorph::program {
namespace {

void add_mesh(std::string& text, const char* role, const MeshReport& mesh) {
    const std::string borders = mesh.closed ? "closed"
                                            : fmt::format("open, {} boundary loop{}", mesh.boundary_loops,
                                                          mesh.boundary_loops == 1 ? "" : "s");
    text += fmt::format("{:<13} {}: {} vertices, {} triangles, {}\n", role, mesh.name, mesh.vertices,
                        mesh.triangles, borders);
    for (const std::string& mended : mesh.mended) text += fmt::format("{:<13} mended: {}\n", "", mended);
}

double angle_degrees(const std::array<double, 9>& rotation) {
    const double cosine = (rotation[0] + rotation[4] + rotation[8] - 1) / 2;
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

void add_registration(std::string& text, const RegistrationReport& registration) {
    if (!registration.used) {
        text += "registration  not used\n";
        return;
    }
    text += fmt::format("registration  turned by {:.1f} degrees, scale {:.4g}, residual {:.3g}{}, {}\n",
                        angle_degrees(registration.rotation), registration.scale, registration.residual,
                        registration.converged ? "" : ", not converged",
                        registration.confident ? "sure" : "UNSURE, see the note");
}

void add_maps(std::string& text, const Report& report) {
    if (!report.domain.empty()) {
        text += fmt::format("domain        {}{}\n", report.domain,
                            report.target_reversed ? ", the target's border turned round" : "");
    }
    if (report.border.merged > 0) {
        text += fmt::format("border        {} + {} vertices, {} of both -> {}\n", report.border.source,
                            report.border.target, report.border.shared, report.border.merged);
    }
    for (const MapReport& map : report.maps) {
        text += fmt::format(
            "map           {}: {}{}, {} flipped, 99 % of the surface shrunk less than {:.2g} times\n", map.of,
            map.weights, map.reason.empty() ? "" : " (" + map.reason + ")", map.flipped, 1 / map.p01);
    }
    if (!report.alignment.limb_matches.empty()) {
        text += fmt::format("limbs         {} and {} found (arms, legs, horns), {} laid on one another\n",
                            report.alignment.limbs_source, report.alignment.limbs_target,
                            report.alignment.limb_matches.size());
    }
    for (const FeatureReport& features : report.features) {
        text += fmt::format("features      {} candidates, {} matched, {} laid on one another\n",
                            features.candidates_source.size(), features.matches.size(), features.in_place);
    }
    for (const OverlayReport& overlay : report.overlays) {
        text += fmt::format("overlay       {} + {} vertices + {} crossings -> {} vertices, {} triangles\n",
                            overlay.vertices_a, overlay.vertices_b, overlay.crossings, overlay.vertices,
                            overlay.triangles);
    }
    if (report.reopened_triangles > 0) {
        text += fmt::format("openings      {} triangles removed again\n", report.reopened_triangles);
    }
}

void add_stages(std::string& text, const Report& report) {
    std::string stages;
    double total = 0, memory = 0;
    for (const StageReport& stage : report.stages) {
        stages += fmt::format("{}{} {:.2f}", stages.empty() ? "" : ", ", stage.name, stage.seconds);
        total += stage.seconds;
        memory = std::max(memory, stage.peak_memory_mb);
    }
    if (!stages.empty())
        text += fmt::format("time          {:.2f} s ({}), peak memory {:.0f} MB\n", total, stages, memory);
}

}  // namespace

std::string meshes_summary(const Report& report) {
    std::string text;
    add_mesh(text, "source", report.source);
    if (report.target.vertices > 0) add_mesh(text, "target", report.target);
    return text;
}

std::vector<std::string> doubts(const Report& report) {
    std::vector<std::string> sentences;
    const RegistrationReport& registration = report.registration;
    if (registration.used && !registration.confident)
        sentences.push_back("the registration is unsure: " + doubt_about(registration));
    if (registration.used && !registration.converged)
        sentences.emplace_back("the registration has not converged");
    return sentences;
}

void warn_of_doubts(const Report& report, const Surroundings& surroundings) {
    for (const std::string& doubt : doubts(report)) surroundings.warn(doubt);
}

void print_morph(const Report& report, const Surroundings& surroundings) {
    if (surroundings.quiet) return warn_of_doubts(report, surroundings);
    fmt::print("{}{}", meshes_summary(report), morph_summary(report));
}

std::string morph_summary(const Report& report) {
    std::string text;
    if (!report.domain.empty() || report.registration.used) add_registration(text, report.registration);
    add_maps(text, report);
    for (const std::string& note : report.notes) text += fmt::format("{:<13} {}\n", "note", note);
    add_stages(text, report);
    return text;
}

}  // namespace automorph::program
