#pragma once

#include <Eigen/Core>

namespace automorph {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< #V x 3, row = vertex
using Triangles =
    Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;  ///< #F x 3, indices into the rows of V

/// An indexed triangle mesh. Triangles are counter-clockwise seen from outside. Units are the file's own.
struct Mesh {
    Points V;
    Triangles F;

    int vertex_count() const { return static_cast<int>(V.rows()); }
    int triangle_count() const { return static_cast<int>(F.rows()); }
};

}  // namespace automorph
