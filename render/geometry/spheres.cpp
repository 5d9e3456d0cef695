#include "render/geometry/spheres.h"

#include <utility>

namespace automorph::render {

Sphere make_sphere(int steps) {
    const int corners = (steps + 1) * (steps + 2) / 2;
    Sphere sphere{Points(8 * corners, 3), Triangles(8 * steps * steps, 3)};
    Eigen::Index vertex = 0, triangle = 0;
    for (int octant = 0; octant < 8; ++octant) {
        const Eigen::RowVector3d sign(octant & 1 ? -1 : 1, octant & 2 ? -1 : 1, octant & 4 ? -1 : 1);
        const bool mirrored = sign.prod() < 0;
        const auto add = [&](int a, int b, int c) {
            if (mirrored) std::swap(b, c);
            sphere.triangles.row(triangle++) << a, b, c;
        };
        // Row i of the face has i + 1 corners, from the pole down to the equator.
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; j <= i; ++j) {
                const Eigen::RowVector3d p(i - j, j, steps - i);
                sphere.directions.row(vertex++) = p.cwiseProduct(sign).normalized();
            }
        }
        const int first = octant * corners;
        const auto at = [&](int i, int j) { return first + i * (i + 1) / 2 + j; };
        for (int i = 0; i < steps; ++i) {
            for (int j = 0; j <= i; ++j) {
                add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
                if (j < i) add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
            }
        }
    }
    return sphere;
}

Points sphere_vertices(const Sphere& sphere, const Points& centers, double radius) {
    const Eigen::Index n = sphere.directions.rows();
    Points V(n * centers.rows(), 3);
    for (Eigen::Index i = 0; i < centers.rows(); ++i)
        V.middleRows(n * i, n) = (radius * sphere.directions).rowwise() + centers.row(i);
    return V;
}

Triangles sphere_triangles(const Sphere& sphere, int count) {
    const Eigen::Index m = sphere.triangles.rows();
    Triangles F(m * count, 3);
    for (int i = 0; i < count; ++i)
        F.middleRows(m * i, m) = sphere.triangles.array() + i * static_cast<int>(sphere.directions.rows());
    return F;
}

}  // namespace automorph::render
