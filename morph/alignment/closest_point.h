#pragma once

#include <array>
#include <memory>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A point of a triangle mesh by its barycentric coordinates.
struct SurfacePlace {
    std::array<int, 3> corners{-1, -1, -1};             ///< vertices; those without weight may be repeated
    Eigen::Vector3d weights = Eigen::Vector3d::Zero();  ///< of the corners, not negative, sum 1

    bool found() const { return corners[0] >= 0; }
    /// The point in 3D, or its image: `rows` is one row per vertex of the mesh.
    Eigen::RowVector3d in(const Points& rows) const {
        return weights[0] * rows.row(corners[0]) + weights[1] * rows.row(corners[1]) +
               weights[2] * rows.row(corners[2]);
    }
};

/// Finds closest points of a mesh whose normals agree with the query's, by a tree that bounds places and
/// normals. Queries may run from several threads.
class ClosestPoints {
public:
    explicit ClosestPoints(const Mesh& mesh);
    ~ClosestPoints();

    /// The closest point among the triangles whose unit normal n' has n . n' > `least_agreement`; among
    /// equally close ones the triangle of smallest index. Not found() where no triangle's normal agrees.
    SurfacePlace query(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                       double least_agreement) const;

    /// The middle of the triangle nearest in place and normal; among equally near ones that of smallest
    /// index. Not found() in a mesh without triangles.
    /// @param scale  distance of centroids, in diagonals of the mesh, that counts as one between unit normals
    SurfacePlace nearest_facet(const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                               double scale) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace automorph
