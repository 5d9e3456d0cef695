#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/mesh.h"

/// The simplest reader of OFF files for the tests of this folder: polygons become fans, unused vertices are
/// dropped. Empty for whatever is not a consistently oriented manifold.
inline std::optional<automorph::Mesh> read_manifold_off(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::stringstream text;
    for (std::string line; std::getline(in, line);) text << line.substr(0, line.find('#')) << '\n';
    std::string magic;
    int vertices = 0, polygons = 0, edges = 0;
    if (!(text >> magic >> vertices >> polygons >> edges) || magic != "OFF") return std::nullopt;
    automorph::Points V(vertices, 3);
    for (int v = 0; v < vertices; ++v) text >> V(v, 0) >> V(v, 1) >> V(v, 2);
    std::vector<int> corners;
    text >> std::ws;
    for (std::string line; std::getline(text, line);) {
        std::istringstream polygon(line);
        int count = 0, a = 0, b = 0, c = 0;
        if (!(polygon >> count >> a >> b)) continue;
        for (int k = 2; k < count && polygon >> c; ++k, b = c) corners.insert(corners.end(), {a, b, c});
    }
    automorph::Mesh mesh;
    mesh.F.resize(static_cast<Eigen::Index>(corners.size() / 3), 3);
    std::vector<int> index(static_cast<std::size_t>(vertices), -1);
    int used = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        if (corners[k] < 0 || corners[k] >= vertices) return std::nullopt;
        int& v = index[static_cast<std::size_t>(corners[k])];
        if (v < 0) v = used++;
        mesh.F(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3)) = v;
    }
    mesh.V.resize(used, 3);
    for (int v = 0; v < vertices; ++v) {
        if (index[static_cast<std::size_t>(v)] >= 0)
            mesh.V.row(index[static_cast<std::size_t>(v)]) = V.row(v);
    }
    try {
        (void)automorph::connectivity(mesh.F, used);
    } catch (const automorph::InvalidMesh&) {
        return std::nullopt;
    }
    return mesh;
}
