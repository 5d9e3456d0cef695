#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/registration/registration.h"

namespace automorph {

/// A point of a surface: a triangle's corners and barycentric coordinates.
struct SurfacePoint {
    std::array<int, 3> corners;
    std::array<double, 3> weights;
};

/// A mesh of which only a part is surface.
struct Surface {
    const Mesh& mesh;
    const std::vector<char>& ignored;  ///< #F: non-zero where there is none, only the filling of an opening
};

/// Points of two registered surfaces that lie near each other and face the same way.
struct SurfaceMatches {
    std::vector<SurfacePoint> on_a, on_b;
    Eigen::VectorXd weights;  ///< #matches, 0..1: confidence, falls with distance and difference of normals
};

/// Matches nearest points in position and normal of two samples that are even in area. Taken are those from
/// which the way back leads to a near neighbour of where it began.
SurfaceMatches match_surfaces(const Surface& a, const Surface& b, const Registration& registration,
                              std::uint64_t seed);

/// Places of surface points under a map: rays of the corners, weighted; unit vectors, #points x 3.
Points rays_of(const Points& rays, const std::vector<SurfacePoint>& points);

}  // namespace automorph
