#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "tests/catch.h"

// Small shapes and helpers of the mesh tests.
namespace automorph::testing {

inline PolygonSoup soup(const std::vector<std::array<double, 3>>& vertices,
                        const std::vector<std::vector<int>>& polygons) {
    PolygonSoup s;
    s.V.resize(static_cast<Eigen::Index>(vertices.size()), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v) {
        for (int k = 0; k < 3; ++k) s.V(static_cast<Eigen::Index>(v), k) = vertices[v][k];
    }
    for (const auto& polygon : polygons) {
        s.polygon_vertices.insert(s.polygon_vertices.end(), polygon.begin(), polygon.end());
        s.polygon_start.push_back(static_cast<int>(s.polygon_vertices.size()));
    }
    return s;
}

inline PolygonSoup tetrahedron() {
    return soup({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

/// The unit cube, six quads, facing outwards.
inline PolygonSoup cube() {
    return soup({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

/// An octahedron split `levels` times, on the unit sphere, facing outwards.
inline Mesh sphere(int levels) {
    std::vector<Eigen::RowVector3d> points = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                              {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    std::vector<std::array<int, 3>> faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                             {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [entry, fresh] =
                middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
            if (fresh) points.push_back((points[a] + points[b]).normalized());
            return entry->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    Mesh mesh;
    mesh.V.resize(static_cast<Eigen::Index>(points.size()), 3);
    mesh.F.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v) mesh.V.row(static_cast<Eigen::Index>(v)) = points[v];
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (int k = 0; k < 3; ++k) mesh.F(static_cast<Eigen::Index>(f), k) = faces[f][k];
    }
    return mesh;
}

/// n x n squares in the plane z = 0, two triangles each, facing +z; vertex (i, j) at (i, j, 0) is j (n + 1) +
/// i. Squares for which `omit` is true are left out.
template <class Omit>
Mesh grid(int n, Omit omit) {
    Mesh mesh;
    mesh.V.resize((n + 1) * (n + 1), 3);
    for (int v = 0; v < mesh.V.rows(); ++v) mesh.V.row(v) << v % (n + 1), v / (n + 1), 0;
    std::vector<int> flat;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            if (omit(i, j)) continue;
            const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            flat.insert(flat.end(), {a, b, c, a, c, d});
        }
    }
    mesh.F = Eigen::Map<const Triangles>(flat.data(), static_cast<Eigen::Index>(flat.size() / 3), 3);
    return mesh;
}

inline Mesh grid(int n) {
    return grid(n, [](int, int) { return false; });
}

/// A torus of n x n quads.
inline PolygonSoup torus(int n) {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::vector<int>> quads;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double u = 2 * M_PI * i / n, v = 2 * M_PI * j / n, r = 2 + std::cos(v);
            vertices.push_back({r * std::cos(u), r * std::sin(u), std::sin(v)});
            const int i1 = (i + 1) % n, j1 = (j + 1) % n;
            quads.push_back({i * n + j, i1 * n + j, i1 * n + j1, i * n + j1});
        }
    }
    return soup(vertices, quads);
}

/// A band of n quads with half a turn.
inline PolygonSoup moebius(int n) {
    std::vector<std::array<double, 3>> vertices;
    std::vector<std::vector<int>> quads;
    for (int i = 0; i < n; ++i) {
        const double u = 2 * M_PI * i / n;
        for (const double s : {-0.3, 0.3}) {
            const double r = 1 + s * std::cos(u / 2);
            vertices.push_back({r * std::cos(u), r * std::sin(u), s * std::sin(u / 2)});
        }
        if (i + 1 < n) quads.push_back({2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1});
    }
    quads.push_back({2 * n - 2, 1, 0, 2 * n - 1});
    return soup(vertices, quads);
}

/// Every polygon with corners of its own, as an STL file has them.
inline PolygonSoup exploded(const PolygonSoup& s) {
    PolygonSoup out;
    out.polygon_start = s.polygon_start;
    out.V.resize(static_cast<Eigen::Index>(s.polygon_vertices.size()), 3);
    for (std::size_t c = 0; c < s.polygon_vertices.size(); ++c) {
        out.V.row(static_cast<Eigen::Index>(c)) = s.V.row(s.polygon_vertices[c]);
        out.polygon_vertices.push_back(static_cast<int>(c));
    }
    return out;
}

/// Both soups in one, the second moved by `shift`.
inline PolygonSoup joined(const PolygonSoup& a, const PolygonSoup& b, const Eigen::RowVector3d& shift) {
    PolygonSoup out = a;
    out.V.conservativeResize(a.V.rows() + b.V.rows(), 3);
    out.V.bottomRows(b.V.rows()) = b.V.rowwise() + shift;
    for (const int v : b.polygon_vertices) out.polygon_vertices.push_back(v + static_cast<int>(a.V.rows()));
    for (std::size_t p = 1; p < b.polygon_start.size(); ++p) {
        out.polygon_start.push_back(b.polygon_start[p] + a.polygon_start.back());
    }
    return out;
}

/// What an action throws: its message, or "" if it throws no E.
template <class E = Error, class Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (const E& error) {
        return error.what();
    }
    return "";
}

inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// Checks that a soup holds the triangle and the quad of the readers' tests: four vertices (v, 10 v, -v).
inline void check_triangle_and_quad(const PolygonSoup& s) {
    REQUIRE(s.V.rows() == 4);
    for (int v = 0; v < 4; ++v) CHECK(s.V.row(v) == Eigen::RowVector3d(v, 10 * v, -v));
    CHECK(s.polygon_start == std::vector<int>{0, 3, 7});
    CHECK(s.polygon_vertices == std::vector<int>{0, 1, 2, 3, 2, 1, 0});
}

}  // namespace automorph::testing
