#pragma once

#include <vector>

#include "morph/overlay/overlay.h"

namespace automorph {

/// A site of a refined mesh (borders inserted, openings filled, halves of a cut) as a site of the mesh it
/// refines.
/// @param vertices  per vertex of the refined mesh: its site on the original
/// @pre the corners of `site` lie in one triangle of the original
Site compose(const Site& site, const std::vector<Site>& vertices);

/// Sum of weights times corners, #sites x 3. Sites at a vertex are that vertex, bit for bit.
Points place(const Points& V, const std::vector<Site>& sites);

constexpr double kLiftCrease =
    30.0;  ///< degrees: triangles of a crease of 60; coarse spheres of 80 triangles are below

/// Unit vertex normals, #V x 3: zero where a triangle faces more than `crease` degrees away from its vertex'
/// normal. What lies around an edge or a corner of a solid is no patch of a smooth surface, and stays flat.
Points smooth_normals(const Mesh& mesh, double crease = kLiftCrease);

/// Curved placement [Krabacher01], [Urtasun04] Sec. 4.4, Eq. (9)-(11): a site p with interpolated unit normal
/// n goes to p + n sum b_i alpha_i. On a sphere with exact normals every lifted point lies on the sphere.
/// Deviations: the sign of the root comes from (n - n_i) . (p - v_i), so that concave patches curve inwards;
/// and the angle between n and n_i counts as at most kMaxBend, since facets across a crease are no patch of a
/// smooth surface.
/// @param normals  #V x 3 unit vertex normals, or zero: such a corner has no say in n and bends nothing, and
/// the height is multiplied by the squared weight of the others. So edges that end in it stay flat, and the
/// patch between them and a curved edge has neither a step nor a tip.
Points lift(const Points& V, const Points& normals, const std::vector<Site>& sites);

}  // namespace automorph
