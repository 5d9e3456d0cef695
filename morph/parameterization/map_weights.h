#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Weights of the convex-combination (or harmonic) map, in the order in which they are tried.
enum class MapWeights { Cotangent, MeanValue, Uniform };

const char* name(MapWeights weights);

/// Edge weights w_ij of the equations sum_j w_ij (h_j - h_i) = 0, one row per free vertex.
struct WeightMatrix {
    Eigen::SparseMatrix<double, Eigen::RowMajor> w;  ///< #free x #V; zero on the diagonal's place
    int guarded = 0;  ///< triangles whose weights had to be bounded (see below)
};

/// Cotangent  cot + cot of the two angles opposite the edge: Eq. (2) over 4 [Eck95, Pinkall93]; symmetric, of
/// any
///            sign. Deviation: a triangle whose angles' cotangents would exceed about kLargestWeight (no
///            area, or edges of no length) is measured with eps added to its three squared edge lengths, eps
///            just large enough; its energy stays positive.
/// MeanValue  (tan(a/2) + tan(b/2)) / |e_ij|, a and b the angles at i beside the edge [Floater03]; positive,
/// not
///            symmetric. Deviation: tangents are at most kLargestWeight, edges at least 1 / kLargestWeight of
///            the mean edge; rows are scaled to sum 1.
/// Uniform    1 [Tutte63].
/// Positive weights give a one-to-one map for any strictly convex border, bounded or not.
/// @param row_of_vertex  #V, row of a free vertex, -1 for fixed ones
/// @param rows           number of free vertices
WeightMatrix weight_matrix(const Mesh& mesh, const std::vector<int>& row_of_vertex, int rows,
                           MapWeights weights);

/// Bound of the weights, without unit: half of the digits of a double stay for the map.
constexpr double kLargestWeight = 1e6;

}  // namespace automorph
