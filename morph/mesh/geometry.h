#pragma once

#include "morph/mesh/mesh.h"

namespace automorph {

/// Axis-aligned bounding box diagonal, in scene units; 0 for an empty mesh.
double bounding_box_diagonal(const Points& V);

/// A mesh's place and size: within it the mesh lies about the origin and has size 1, as floats and tolerances
/// want it.
struct UnitFrame {
    Eigen::RowVector3d centre;  ///< of the bounding box
    double size;                ///< diagonal of the bounding box, > 0

    /// The frame of a mesh that has vertices.
    explicit UnitFrame(const Points& V);

    Points in(const Points& V) const { return (V.rowwise() - centre) / size; }
};

/// Normal of a triangle, twice its area long; zero if it has none.
Eigen::Vector3d doubled_area_vector(const Points& V, const Triangles& F, Eigen::Index f);

/// Length of a triangle's longest edge.
double longest_edge(const Points& V, const Triangles& F, Eigen::Index f);

/// A triangle of less height than this, in bounding box diagonals, is flat: rounding decides where it faces.
constexpr double kFlatHeight = 1e-10;

/// Area of each triangle, in squared scene units (#F).
Eigen::VectorXd triangle_areas(const Mesh& mesh);

/// Area-weighted centre of mass of the surface. Falls back to the mean of the vertices when the area is zero.
Eigen::Vector3d centre_of_mass(const Mesh& mesh);

/// A third of the area of the incident triangles, per vertex (#V).
Eigen::VectorXd vertex_areas(const Mesh& mesh);

/// Unit vertex normals (#V x 3), weighted by the angle of each incident triangle (Thuermer and Wuethrich
/// 1998). A vertex whose incident triangles all have zero area gets the zero vector.
Points vertex_normals(const Mesh& mesh);

/// Unit vertex normals (#V x 3), each triangle weighted by its area: the needles of merged meshes, whose own
/// normals are rounding, do not count. Zero where there is no area.
Points area_weighted_normals(const Points& V, const Triangles& F);

/// Signed volume enclosed by a closed mesh; positive when the triangles face outwards.
double signed_volume(const Mesh& mesh);

}  // namespace automorph
