#pragma once

#include <Eigen/Core>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Distances along a surface.
///
/// Method  Dijkstra's shortest paths over the edges and over the straight lines across two triangles that
/// share
///         an edge, unfolded into a plane: paths zigzag less than along edges alone, and no sliver does harm.
///         On even triangles distances come out 0 to 5 % too long.
class SurfaceDistances {
public:
    /// @throws InvalidMesh if an edge has more than two triangles
    explicit SurfaceDistances(const Mesh& mesh);

    /// Distance of every vertex from the nearest of some, in the mesh's unit (#V); infinite where no path
    /// leads.
    Eigen::VectorXd from(const std::vector<int>& vertices) const;

private:
    std::vector<int> start_, to_;  // of vertex v: start_[v] .. start_[v + 1]
    std::vector<double> length_;
};

}  // namespace automorph
