#pragma once

#include "morph/mesh/mesh.h"
#include "morph/morph.h"
#include "morph/parameterization/border_union.h"
#include "morph/report.h"

/// The method's intermediate results for their own sake: what Figs. 2 and 3 of [Urtasun04] show.
namespace automorph {

/// A shape alone on its domain.
struct ShapeMap {
    Mesh mesh;              ///< its vertices first; openings other than the border are filled
    int own_triangles = 0;  ///< triangles beyond these are fillings
    std::vector<int> loop;  ///< border; empty of a closed shape
    Points rays;            ///< #V x 3: (x, y, 1) on the unit disk, or unit vectors on the sphere
    MapReport report;
};

/// The harmonic map of an open shape onto the disk with its border by arc length, Sec. 3; of a closed one the
/// progressive embedding on the sphere.
/// @throws SolverFailure  every choice of weights flips a triangle
ShapeMap map_shape(const InputMesh& shape);

/// The common border of two open shapes in register, Sec. 4.2.
struct BorderInsertion {
    Points source, target;  ///< #loop x 3: the borders' own vertices, in the order of the union's sites
    BorderUnion border;
    RegistrationReport registration;
};

/// @throws InvalidMesh  a shape is closed
BorderInsertion insert_borders(const InputMesh& source, const InputMesh& target, std::uint64_t seed = 1);

}  // namespace automorph
