#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "morph/mesh/mesh.h"

// Surfaces of known curvature in regular triangles, every inner vertex of valence 6.
namespace automorph::testing {

/// n x m quads, each in two triangles along the same diagonal; index(i, j) wraps where the surface closes.
template <class Index>
Triangles quads(int n, int m, const Index& index) {
    Triangles F(2 * n * m, 3);
    int row = 0;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            F.row(row++) << index(i, j), index(i + 1, j), index(i + 1, j + 1);
            F.row(row++) << index(i, j), index(i + 1, j + 1), index(i, j + 1);
        }
    }
    return F;
}

/// An open cylinder round z of height 2 r, facing outwards: n quads round it, n / 2 along it.
inline Mesh cylinder(double radius, int n) {
    Mesh mesh;
    const int m = n / 2;
    mesh.V.resize(n * (m + 1), 3);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= m; ++j) {
            const double u = 2.0 * std::numbers::pi * i / n;
            mesh.V.row(i * (m + 1) + j) << radius * std::cos(u), radius * std::sin(u), 2.0 * radius * j / m;
        }
    }
    mesh.F = quads(n, m, [&](int i, int j) { return i % n * (m + 1) + j; });
    return mesh;
}

/// A torus round z, facing outwards: n quads round the axis, m round the tube.
inline Mesh ring(double radius, double tube, int n, int m) {
    Mesh mesh;
    mesh.V.resize(n * m, 3);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            const double u = 2.0 * std::numbers::pi * i / n, v = 2.0 * std::numbers::pi * j / m;
            const double r = radius + tube * std::cos(v);
            mesh.V.row(i * m + j) << r * std::cos(u), r * std::sin(u), tube * std::sin(v);
        }
    }
    mesh.F = quads(n, m, [&](int i, int j) { return i % n * m + j % m; });
    return mesh;
}

/// The graph z = height(x, y) over [-1/2, 1/2]^2 in n x n quads, facing +z.
template <class Height>
Mesh graph(int n, const Height& height) {
    Mesh mesh;
    mesh.V.resize((n + 1) * (n + 1), 3);
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            const double x = static_cast<double>(i) / n - 0.5, y = static_cast<double>(j) / n - 0.5;
            mesh.V.row(i * (n + 1) + j) << x, y, height(x, y);
        }
    }
    mesh.F = quads(n, n, [&](int i, int j) { return i * (n + 1) + j; });
    return mesh;
}

}  // namespace automorph::testing
