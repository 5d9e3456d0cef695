#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "morph/mesh/admit.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/io.h"
#include "morph/mesh/mesh.h"

namespace automorph::test {

inline double degrees(double radians) {
    return radians * 180.0 / std::numbers::pi;
}

/// Random numbers that are the same with every standard library.
class Random {
public:
    explicit Random(std::uint64_t seed) : generator_(seed) {}

    double uniform() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }

    double normal() {  // Box and Muller
        return std::sqrt(-2.0 * std::log(1.0 - uniform())) * std::cos(2.0 * std::numbers::pi * uniform());
    }

    Eigen::Vector3d normal3() {
        const double x = normal(), y = normal(), z = normal();
        return {x, y, z};
    }

    Eigen::Matrix3d rotation() {
        const double w = normal(), x = normal(), y = normal(), z = normal();
        return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
    }

private:
    std::mt19937_64 generator_;
};

inline Points random_points(int n, Random& random) {
    Points points(n, 3);
    for (int i = 0; i < n; ++i) points.row(i) = random.normal3();
    return points;
}

inline Mesh mesh_of(const std::vector<Eigen::Vector3d>& points,
                    const std::vector<Eigen::Vector3i>& triangles) {
    Mesh mesh{Points(points.size(), 3), Triangles(triangles.size(), 3)};
    for (std::size_t i = 0; i < points.size(); ++i) mesh.V.row(i) = points[i];
    for (std::size_t i = 0; i < triangles.size(); ++i) mesh.F.row(i) = triangles[i];
    return mesh;
}

/// Numbers the midpoints of edges as they are asked for.
class Midpoints {
public:
    int operator()(const Points& V, int a, int b) {
        const auto [place, is_new] = number_.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
        if (is_new) points.push_back(0.5 * (V.row(a) + V.row(b)));
        return place->second;
    }

    std::vector<Eigen::Vector3d> points;

private:
    std::map<std::pair<int, int>, int> number_;
};

/// Another tessellation of the same surface that shares no vertex with the first: the vertices are the
/// midpoints of the edges, the faces are the middles of the old ones and, in place of each old vertex, a fan.
/// Corners are cut.
inline Mesh re_tessellated(const Mesh& mesh) {
    Midpoints midpoint;
    std::vector<Eigen::Vector3i> triangles;
    std::vector<int> hub(mesh.vertex_count(), -1);  // where the fan that replaces a vertex starts
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const Eigen::Vector3i v = mesh.F.row(f);
        Eigen::Vector3i middle;
        for (int k = 0; k < 3; ++k) middle[k] = midpoint(mesh.V, v[k], v[(k + 1) % 3]);
        triangles.push_back(middle);
        for (int k = 0; k < 3; ++k) {
            const int next = middle[k], previous = middle[(k + 2) % 3];
            if (hub[v[k]] < 0) hub[v[k]] = next;
            if (hub[v[k]] != next && hub[v[k]] != previous) triangles.emplace_back(hub[v[k]], next, previous);
        }
    }
    return mesh_of(midpoint.points, triangles);
}

/// Unit sphere, an icosahedron split `levels` times: 10 * 4^levels + 2 vertices.
inline Mesh icosphere(int levels) {
    const double g = std::numbers::phi;
    std::vector<Eigen::Vector3d> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                           {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                           {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    std::vector<Eigen::Vector3i> triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                              {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                              {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                              {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    Mesh mesh = mesh_of(points, triangles);
    for (int level = 0; level < levels; ++level) {
        Midpoints midpoint;
        triangles.clear();
        const int n = mesh.vertex_count();
        for (int f = 0; f < mesh.triangle_count(); ++f) {
            const Eigen::Vector3i v = mesh.F.row(f);
            Eigen::Vector3i middle;
            for (int k = 0; k < 3; ++k) middle[k] = n + midpoint(mesh.V, v[k], v[(k + 1) % 3]);
            triangles.push_back(middle);
            for (int k = 0; k < 3; ++k) triangles.emplace_back(v[k], middle[k], middle[(k + 2) % 3]);
        }
        points.clear();
        for (int i = 0; i < n; ++i) points.emplace_back(mesh.V.row(i));
        points.insert(points.end(), midpoint.points.begin(), midpoint.points.end());
        mesh = mesh_of(points, triangles);
    }
    mesh.V.rowwise().normalize();
    return mesh;
}

/// Unit sphere by rings of longitude and latitude, every other ring shifted by half a step.
inline Mesh ring_sphere(int rings, int per_ring) {
    std::vector<Eigen::Vector3d> points = {{0, 0, 1}};
    for (int i = 1; i < rings; ++i) {
        for (int j = 0; j < per_ring; ++j) {
            const double theta = std::numbers::pi * i / rings;
            const double phi = 2.0 * std::numbers::pi * (j + 0.5 * (i % 2)) / per_ring;
            points.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                std::cos(theta));
        }
    }
    points.emplace_back(0, 0, -1);
    const int south = static_cast<int>(points.size()) - 1;
    const auto at = [&](int i, int j) { return 1 + (i - 1) * per_ring + j % per_ring; };
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j < per_ring; ++j) {
        triangles.emplace_back(0, at(1, j), at(1, j + 1));
        triangles.emplace_back(south, at(rings - 1, j + 1), at(rings - 1, j));
        for (int i = 1; i + 1 < rings; ++i) {
            const int a = at(i, j), b = at(i, j + 1), c = at(i + 1, j), d = at(i + 1, j + 1);
            if (i % 2 == 1) {
                triangles.emplace_back(a, c, d);
                triangles.emplace_back(a, d, b);
            } else {
                triangles.emplace_back(a, c, b);
                triangles.emplace_back(b, c, d);
            }
        }
    }
    return mesh_of(points, triangles);
}

/// Turns the unit sphere into a smooth shape without symmetry: five bumps and dents, about `height` high.
inline Mesh with_bumps(Mesh sphere, double height) {
    const std::vector<std::pair<Eigen::Vector3d, double>> bumps = {{{1, 0.2, 0.3}, 1.0},
                                                                   {{-0.4, 1, 0.1}, 0.7},
                                                                   {{0.1, -0.3, 1}, -0.6},
                                                                   {{-0.8, -0.5, -0.4}, 0.8},
                                                                   {{0.5, -0.7, 0.6}, 0.5}};
    for (int v = 0; v < sphere.vertex_count(); ++v) {
        const Eigen::Vector3d direction = sphere.V.row(v);
        double radius = 1.0;
        for (const auto& [centre, share] : bumps) {
            radius += height * share * std::exp(6.0 * (centre.normalized().dot(direction) - 1.0));
        }
        sphere.V.row(v) *= radius;
    }
    return sphere;
}

inline Mesh stretched(Mesh mesh, const Eigen::Vector3d& factors) {
    mesh.V = mesh.V * factors.asDiagonal();
    return mesh;
}

/// The triangles whose centre is on the positive side of a plane, with their vertices.
inline Mesh cropped(const Mesh& mesh, const Eigen::Vector3d& normal, double offset) {
    std::vector<int> number(mesh.vertex_count(), -1);
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        Eigen::Vector3i v = mesh.F.row(f);
        if ((mesh.V.row(v[0]) + mesh.V.row(v[1]) + mesh.V.row(v[2])).dot(normal) / 3.0 < offset) continue;
        for (int k = 0; k < 3; ++k) {
            if (number[v[k]] < 0) {
                number[v[k]] = static_cast<int>(points.size());
                points.emplace_back(mesh.V.row(v[k]));
            }
            v[k] = number[v[k]];
        }
        triangles.push_back(v);
    }
    return mesh_of(points, triangles);
}

/// The same surface with its triangles turned round.
inline Mesh reversed(Mesh mesh) {
    mesh.F.col(1).swap(mesh.F.col(2));
    return mesh;
}

/// Gaussian noise on every coordinate, of a share of the bounding box's diagonal.
inline Mesh with_noise(Mesh mesh, double share, Random& random) {
    const double sigma = share * bounding_box_diagonal(mesh.V);
    for (int v = 0; v < mesh.vertex_count(); ++v) mesh.V.row(v) += sigma * random.normal3().transpose();
    return mesh;
}

/// y = scale R x + t for every vertex.
inline Mesh moved(Mesh mesh, const Eigen::Matrix3d& R, const Eigen::Vector3d& t, double scale) {
    mesh.V = (scale * mesh.V * R.transpose()).rowwise() + t.transpose();
    return mesh;
}

/// A mesh of libcgal-demo; empty if the files are not there.
inline Mesh demo_mesh(const std::string& name) {
    const std::filesystem::path file = std::filesystem::path(AUTOMORPH_DEMO_MESHES) / (name + ".off");
    if (!std::filesystem::exists(file)) return {};
    return admit(read_mesh(file), name).mesh;
}

}  // namespace automorph::test
