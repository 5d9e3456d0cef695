#pragma once

#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/parameterization/sphere_border.h"
#include "morph/parameterization/sphere_relaxation.h"

namespace automorph {

/// A valid map onto the sphere that is moved and relaxed, and stays valid.
class MovableMap {
public:
    /// @param loop  locked border, whose vertices stay; empty for a closed mesh
    /// @param rays  #V x 3, unit vectors
    MovableMap(const Mesh& mesh, const std::vector<int>& loop, const Points& rays);

    Points rays() const { return relaxation_.rays.topRows(mesh_.vertex_count()); }

    /// Moves all vertices but those of the border towards `wanted` (#V x 3, unit vectors) as far as the map
    /// stays valid (guarded_move.h), and covers the sphere once: all triangles may be positive, with vertices
    /// gone round twice. Returns those that did not get there.
    /// @throws SolverFailure  the map covered the sphere more than once before
    std::vector<int> move(const Points& wanted);

    /// The same in several rounds with relaxing sweeps in between, which make room; vertices that do not get
    /// there in the end are relaxed among the others. Returns how many those are.
    int follow(const Points& wanted);

    /// At most so many relaxing sweeps (sphere_relaxation.h).
    void relax(int sweeps);

private:
    const Mesh& mesh_;
    ClosedMesh closed_;
    SphereRelaxation relaxation_;
    std::vector<int> vertices_;  ///< that may move
};

}  // namespace automorph
