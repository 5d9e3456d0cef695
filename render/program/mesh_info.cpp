#include "render/program/mesh_info.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/io.h"

namespace automorph::program {
namespace {

// Loops that the text tells of one by one; scans can have hundreds.
constexpr std::size_t kLoopsShown = 5;

MeshInfo::Loop measured(const std::vector<int>& loop, const Points& V) {
    MeshInfo::Loop result{static_cast<int>(loop.size()), 0.0};
    for (std::size_t i = 0; i < loop.size(); ++i) {
        result.length += (V.row(loop[i]) - V.row(loop[(i + 1) % loop.size()])).norm();
    }
    return result;
}

void examine_admitted(MeshInfo& info, const PolygonSoup& soup) {
    AdmittedMesh admitted = admit(soup, info.file);
    info.mended = std::move(admitted.mended);
    info.admitted = admitted.admitted;
    for (const std::vector<int>& loop : boundary_loops(admitted.mesh)) {
        info.loops.push_back(measured(loop, admitted.mesh.V));
    }
    info.area = triangle_areas(admitted.mesh).sum();
    if (info.admitted.closed) info.volume = signed_volume(admitted.mesh);
}

/// "1 edge", "2 edges"; the plural is given where it is not an s.
std::string counted(int count, const std::string& what, const std::string& plural = "") {
    return fmt::format("{} {}", count, count == 1 ? what : plural.empty() ? what + "s" : plural);
}

std::string topology(const MeshInspection& mesh) {
    return fmt::format("{}, {}, {}", counted(mesh.components, "part"),
                       mesh.closed ? "closed" : counted(mesh.boundary_loops, "boundary loop"),
                       mesh.genus >= 0    ? fmt::format("genus {}", mesh.genus)
                       : !mesh.orientable ? "one-sided (a Moebius strip)"
                                          : "not manifold");
}

std::string defects(const MeshInspection& mesh) {
    std::string text;
    const auto add = [&](int count, const char* what, const char* plural) {
        if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, what, plural);
    };
    add(mesh.non_manifold_edges, "edge of three or more triangles", "edges of three or more triangles");
    add(mesh.non_manifold_vertices, "vertex where surfaces touch", "vertices where surfaces touch");
    add(mesh.degenerate_triangles, "triangle with a repeated corner", "triangles with a repeated corner");
    add(mesh.duplicate_vertices, "duplicate vertex", "duplicate vertices");
    add(mesh.unused_vertices, "unused vertex", "unused vertices");
    add(mesh.inconsistent_edges, "edge between triangles of opposite orientation",
        "edges between triangles of opposite orientation");
    return text.empty() ? "none" : text;
}

std::string loops_text(const std::vector<MeshInfo::Loop>& loops) {
    std::string text;
    for (std::size_t i = 0; i < std::min(loops.size(), kLoopsShown); ++i) {
        text += fmt::format("{}{} of {}, {:.4g} long", i == 0 ? "" : ", ", i == 0 ? "the border" : "opening",
                            counted(loops[i].vertices, "vertex", "vertices"), loops[i].length);
    }
    if (loops.size() > kLoopsShown) text += fmt::format(", {} more", loops.size() - kLoopsShown);
    return text;
}

using Json = nlohmann::ordered_json;

Json json(const Eigen::Vector3d& v) {
    return Json::array({v.x(), v.y(), v.z()});
}

Json json(const MeshInspection& mesh) {
    return {{"vertices", mesh.vertices},
            {"polygons", mesh.polygons},
            {"triangles", mesh.triangles},
            {"components", mesh.components},
            {"closed", mesh.closed},
            {"boundary_loops", mesh.boundary_loops},
            {"boundary_edges", mesh.boundary_edges},
            {"euler_characteristic", mesh.euler_characteristic},
            {"genus", mesh.genus >= 0 ? Json(mesh.genus) : Json(nullptr)},
            {"orientable", mesh.orientable},
            {"non_manifold_edges", mesh.non_manifold_edges},
            {"non_manifold_vertices", mesh.non_manifold_vertices},
            {"degenerate_triangles", mesh.degenerate_triangles},
            {"duplicate_vertices", mesh.duplicate_vertices},
            {"unused_vertices", mesh.unused_vertices},
            {"inconsistent_edges", mesh.inconsistent_edges}};
}

Json json(const MeshInfo& info) {
    Json result = {{"file", info.file}, {"admissible", info.refusal.empty()}};
    if (!info.refusal.empty()) result["refusal"] = info.refusal;
    if (!info.readable) return result;
    result["bounding_box"] = {{"low", json(info.low)}, {"high", json(info.high)}};
    result["diagonal"] = (info.high - info.low).norm();
    result["found"] = json(info.found);
    if (!info.refusal.empty()) return result;
    result["mended"] = info.mended;
    result["admitted"] = json(info.admitted);
    Json loops = Json::array();
    for (const MeshInfo::Loop& loop : info.loops) {
        loops.push_back({{"vertices", loop.vertices}, {"length", loop.length}});
    }
    result["loops"] = std::move(loops);
    result["area"] = info.area;
    if (info.admitted.closed) result["volume"] = info.volume;
    return result;
}

}  // namespace

MeshInfo examine(const std::filesystem::path& file) {
    MeshInfo info;
    info.file = file.string();
    try {
        const PolygonSoup soup = read_mesh(file);
        info.readable = true;
        if (soup.V.rows() > 0) {
            info.low = soup.V.colwise().minCoeff();
            info.high = soup.V.colwise().maxCoeff();
        }
        info.found = inspect(soup);
        examine_admitted(info, soup);
    } catch (const Error& error) {
        info.refusal = error.what();
    }
    return info;
}

std::string info_text(const MeshInfo& info) {
    std::string text = info.file + "\n";
    const auto line = [&](const char* name, const std::string& content) {
        text += fmt::format("  {:<10} {}\n", name, content);
    };
    if (info.readable) {
        const Eigen::Vector3d extent = info.high - info.low;
        line("file",
             fmt::format("{}, {}, {}", counted(info.found.vertices, "vertex", "vertices"),
                         counted(info.found.polygons, "polygon"), counted(info.found.triangles, "triangle")));
        line("size", fmt::format("{:.4g} x {:.4g} x {:.4g}, diagonal {:.4g}", extent.x(), extent.y(),
                                 extent.z(), extent.norm()));
        line("surface", topology(info.found));
        line("defects", defects(info.found));
    }
    if (!info.refusal.empty()) {
        const std::string place = info.file + ": ";  // stands above already
        const bool repeated = info.refusal.starts_with(place);
        text += fmt::format("  cannot be {}: {}\n", info.readable ? "morphed" : "read",
                            info.refusal.substr(repeated ? place.size() : 0));
        return text;
    }
    for (const std::string& mended : info.mended) line("mending", mended);
    if (!info.loops.empty()) line("borders", loops_text(info.loops));
    line("area", fmt::format("{:.4g}{}", info.area,
                             info.admitted.closed ? fmt::format(", volume {:.4g}", info.volume) : ""));
    text +=
        fmt::format("  can be morphed: {}, {}, {}\n", counted(info.admitted.vertices, "vertex", "vertices"),
                    counted(info.admitted.triangles, "triangle"), info.admitted.closed ? "closed" : "open");
    return text;
}

std::string info_json(const std::vector<MeshInfo>& meshes) {
    Json root = Json::array();
    for (const MeshInfo& info : meshes) root.push_back(json(info));
    return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace automorph::program
