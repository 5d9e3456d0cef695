#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Where a surface is and how large: registration compares copies (x - centre) / radius.
struct SurfaceSize {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< area-weighted centre of mass
    double radius = 0.0;  ///< root mean square distance of the surface to its centre, exact for the triangles
};

/// @throws InvalidMesh  no triangles, a coordinate that is not finite, or zero area
SurfaceSize surface_size(const Mesh& mesh);

/// Points spread evenly over a surface, each standing for the same area.
struct SurfaceSample {
    Points points;   ///< #n x 3, size-normalised: centre at 0, root mean square radius 1
    Points normals;  ///< #n x 3, unit vertex normals, interpolated

    int size() const { return static_cast<int>(points.rows()); }
};

/// `count` points, one at random in each of `count` stretches of equal area, sorted along a Morton curve, so that
/// every k-th row is an even, coarser sample. The same seed gives the same sample with any standard library.
SurfaceSample sample_surface(const Mesh& mesh, const SurfaceSize& size, int count, std::uint64_t seed);

/// `count` rows at even distances (all of them if there are fewer).
SurfaceSample thin_out(const SurfaceSample& sample, int count);

/// True if every edge has a triangle on either side.
bool is_closed(const Mesh& mesh);

}  // namespace automorph
