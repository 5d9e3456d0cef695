#pragma once

#include "morph/domain_map.h"
#include "morph/mesh/mesh.h"
#include "morph/morph.h"
#include "morph/parameterization/border_union.h"
#include "morph/report.h"

/// The method's intermediate results for their own sake: what Figs. 2 and 3 of [Urtasun04] show.
namespace automorph {

/// A shape alone on its domain; the shape's own vertices come first, and so do its triangles.
struct ShapeMap : DomainMap {
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
