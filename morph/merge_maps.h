#pragma once

#include <string>
#include <vector>

#include "morph/domain_map.h"
#include "morph/overlay/overlay.h"
#include "morph/parameterization/map_quality.h"
#include "morph/report.h"

namespace automorph {

/// One of the two shapes of a morph: where merged vertices are placed.
struct Shape {
    Mesh mesh;         ///< openings filled
    Points normals;    ///< #V x 3 of the unfilled surface (smooth_normals); zero at the centres of fillings
    int own_vertices;  ///< vertices beyond these are centres of fillings
};

/// A mesh on its way to the overlay: the whole of a shape or a part of it, refined (borders inserted, chords
/// split), and its map.
struct MappedPart {
    Mesh mesh;
    std::vector<int> loop;    ///< its border; empty for a closed mesh
    std::vector<Site> sites;  ///< per vertex: where it lies on the shape
    Points rays;              ///< #V x 3, the map
};

/// Two parts with one connectivity.
struct MergedPair {
    Triangles F;                   ///< merged triangles
    std::vector<Site> on_a, on_b;  ///< per merged vertex: its place on shape a, on shape b
    Points points_a, points_b;     ///< #merged x 3: there, curved by Eq. (9)-(11) or on the flat facets
    std::vector<int> border;  ///< merged vertices of the border in the order of a's loop; empty without one
    std::vector<char> in_filling;  ///< per merged triangle: it lies in a filled opening of either shape
    std::vector<DomainMaps> maps;  ///< that were overlaid: one pair, or one per half
};

/// Per triangle of a part: it lies in a filled opening, i.e. one of its corners is the centre of a filling.
std::vector<char> filling_triangles(const Shape& shape, const MappedPart& part);

/// The triangles that are not in fillings, in their order. @param filling  per triangle
Triangles without_fillings(const Triangles& F, const std::vector<char>& filling);

/// Overlay and triangulation of two maps of the same domain, [Urtasun04] Sec. 3, and the places of the merged
/// vertices. Where the curved placement would turn a merged triangle against the shape it lies in, the
/// triangle's corners are left on the flat facets. Adds its stages and the overlay to the report.
/// @param label  " half 1" or "": tells the parts of one morph apart in the report
/// @throws SolverFailure  the maps do not cover the same domain
MergedPair merge_maps(const Shape& shape_a, const MappedPart& a, const Shape& shape_b, MappedPart b,
                      bool curved, const std::string& label, Report& report);

}  // namespace automorph
