#pragma once

#include "morph/merge_maps.h"

namespace automorph {

/// What smooth shading of a merged mesh lacks at one end of a morph, #merged x 3: added to the mesh's unit
/// vertex normals, each triangle weighted by its area, it gives the shape's own interpolated vertex normals.
/// A merged mesh is a fine mesh on the coarse facets of its shapes; its own normals show those facets. Zero
/// where a corner of the site lies on an edge of a solid: there the facets are to be seen.
/// @param sites   where the merged vertices lie on the shape
/// @param points  #merged x 3, their places
Points shading_correction(const Shape& shape, const std::vector<Site>& sites, const Points& points,
                          const Triangles& F);

}  // namespace automorph
