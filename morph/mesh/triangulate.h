#pragma once

#include <vector>

#include "morph/mesh/io.h"

namespace automorph {

/// The triangles of a soup.
struct TriangulatedSoup {
    Triangles F;               ///< none repeats a corner
    std::vector<int> polygon;  ///< per triangle: the polygon it comes from
    int split_polygons = 0;    ///< polygons of four or more corners
    int degenerate = 0;        ///< triangles left out: a corner repeated
    int too_small = 0;         ///< polygons of fewer than three corners, left out
    int too_large = -1;        ///< a polygon beyond kLargestPolygon (split as a fan), or -1
};

/// Splitting an n-gon costs up to n^2 steps; larger ones do not come from modelling.
inline constexpr int kLargestPolygon = 10000;

/// Splits polygons into triangles, n - 2 each, over their own corners only. Ears are cut in the polygon's
/// mean plane (Newell's normal), the best-shaped first, so concave polygons stay within themselves; a
/// diagonal that is already an edge of the soup is used only where there is no other, since it would not be
/// manifold.
TriangulatedSoup triangulate(const PolygonSoup& soup);

}  // namespace automorph
