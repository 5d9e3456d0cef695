#pragma once

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "morph/mesh/mesh.h"

// Shapes built in code for the tests of the path tracer.
namespace automorph::render {

struct Shape {
    Points V;
    Triangles F;
};

inline Shape make_shape(const std::vector<Eigen::Vector3d>& points,
                        const std::vector<std::array<int, 3>>& faces) {
    Shape shape{Points(static_cast<int>(points.size()), 3), Triangles(static_cast<int>(faces.size()), 3)};
    for (std::size_t i = 0; i < points.size(); ++i) shape.V.row(static_cast<int>(i)) = points[i];
    for (std::size_t i = 0; i < faces.size(); ++i) {
        shape.F.row(static_cast<int>(i)) << faces[i][0], faces[i][1], faces[i][2];
    }
    return shape;
}

/// The square |x|, |y| <= half at height z, facing up.
inline Shape square(double half, double z) {
    return make_shape({{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
                      {{0, 1, 2}, {0, 2, 3}});
}

/// The box [-1, 1]^3, facing out.
inline Shape box() {
    return make_shape(
        {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}},
        {{0, 2, 3},
         {0, 3, 1},
         {4, 5, 7},
         {4, 7, 6},
         {0, 1, 5},
         {0, 5, 4},
         {2, 6, 7},
         {2, 7, 3},
         {0, 4, 6},
         {0, 6, 2},
         {1, 3, 7},
         {1, 7, 5}});
}

/// Icosahedron with each triangle split into four `levels` times, vertices on the unit sphere.
inline Shape icosphere(int levels) {
    const double g = 0.5 * (1.0 + std::sqrt(5.0));
    std::vector<Eigen::Vector3d> points{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                        {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                        {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    std::vector<std::array<int, 3>> faces{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                          {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                          {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                          {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [place, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
            if (is_new) {
                points.push_back(0.5 *
                                 (points[static_cast<std::size_t>(a)] + points[static_cast<std::size_t>(b)]));
            }
            return place->second;
        };
        std::vector<std::array<int, 3>> split;
        for (const auto& [a, b, c] : faces) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            split.insert(split.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = split;
    }
    for (Eigen::Vector3d& p : points) p.normalize();
    return make_shape(points, faces);
}

}  // namespace automorph::render
