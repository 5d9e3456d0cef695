#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "morph/exact/predicates.h"
#include "morph/mesh/mesh.h"
#include "tests/morph/parameterization/disks.h"

// Graphs over the unit disk, which are their own maps.
namespace automorph::testing {

struct GraphDisk {
    Mesh mesh;  ///< z over the disk
    std::vector<int> loop;
    Points rays;  ///< (x, y, 1)
};

/// The graph of a height over a disk of `rings` rings; the last ring is the border.
inline GraphDisk graph_disk(int rings, double jitter, unsigned seed,
                            const std::function<double(double, double)>& height) {
    GraphDisk disk;
    disk.mesh = disks::flat(rings, jitter, seed);
    disk.rays = disk.mesh.V;
    disk.rays.col(2).setOnes();
    for (int v = 0; v < disk.mesh.vertex_count(); ++v)
        disk.mesh.V(v, 2) = height(disk.mesh.V(v, 0), disk.mesh.V(v, 1));
    for (int v = disk.mesh.vertex_count() - 6 * rings; v < disk.mesh.vertex_count(); ++v)
        disk.loop.push_back(v);
    return disk;
}

/// cos(pi x) cos(pi y) / 2: K is smallest at the four saddles (+-1/2, +-1/2), with K = -pi^4 / 4 there.
inline double egg_box(double x, double y) {
    return 0.5 * std::cos(std::numbers::pi * x) * std::cos(std::numbers::pi * y);
}

inline int flipped(const Triangles& F, const Points& rays) {
    int count = 0;
    for (int f = 0; f < F.rows(); ++f)
        count += orientation(rays.row(F(f, 0)), rays.row(F(f, 1)), rays.row(F(f, 2))) <= 0;
    return count;
}

inline int nearest(const Points& rays, double x, double y) {
    Eigen::Index best = 0;
    (rays.rowwise() - Eigen::RowVector3d(x, y, 1)).rowwise().squaredNorm().minCoeff(&best);
    return static_cast<int>(best);
}

}  // namespace automorph::testing
