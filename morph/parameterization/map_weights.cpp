#include "morph/parameterization/map_weights.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace automorph {

namespace {

using Corners = std::array<double, 3>;

/// A triangle's values at its corners and whether they had to be bounded.
struct Element {
    Corners corner;
    bool guarded = false;
};

/// Vector along edge k, from corner k + 1 to corner k + 2 (opposite corner k).
std::array<Eigen::Vector3d, 3> edges(const Mesh& mesh, int f) {
    std::array<Eigen::Vector3d, 3> e;
    for (int k = 0; k < 3; ++k) {
        e[static_cast<std::size_t>(k)] =
            mesh.V.row(mesh.F(f, (k + 2) % 3)) - mesh.V.row(mesh.F(f, (k + 1) % 3));
    }
    return e;
}

/// Cotangents of the three angles.
Element cotangents(const Mesh& mesh, int f) {
    const auto e = edges(mesh, f);
    const Corners l2{e[0].squaredNorm(), e[1].squaredNorm(), e[2].squaredNorm()};
    const double sum = l2[0] + l2[1] + l2[2];
    if (!(sum > 0.0))
        return {{1 / std::sqrt(3.0), 1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}, true};  // equilateral
    const double area2 = 4.0 * e[1].cross(e[2]).squaredNorm();                        // 16 A^2
    // With eps added to all squared lengths 16 A^2 grows by 2 eps sum + 3 eps^2.
    const double smallest = sum * sum / (kLargestWeight * kLargestWeight);
    const double eps = std::max(0.0, (smallest - area2) / (2.0 * sum));
    const double area4 = std::sqrt(area2 + 2.0 * eps * sum + 3.0 * eps * eps);  // 4 A
    Element cot;
    cot.guarded = eps > 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        // cot = (l_i^2 + l_j^2 - l_k^2) / 4A; the scalar product has no cancellation of squares.
        cot.corner[k] = (-2.0 * e[(k + 1) % 3].dot(e[(k + 2) % 3]) + eps) / area4;
    }
    return cot;
}

/// Tangents of half of the three angles.
Element half_tangents(const Mesh& mesh, int f) {
    const auto e = edges(mesh, f);
    const double area2 = e[1].cross(e[2]).norm();
    Element tangent;
    for (std::size_t k = 0; k < 3; ++k) {
        const double lengths = e[(k + 1) % 3].norm() * e[(k + 2) % 3].norm();
        const double denominator = lengths - e[(k + 1) % 3].dot(e[(k + 2) % 3]);
        if (!(lengths > 0.0)) {
            tangent.corner[k] = 1.0;  // no angle: a right one
            tangent.guarded = true;
        } else if (area2 <= denominator * kLargestWeight && area2 * kLargestWeight >= denominator) {
            tangent.corner[k] = area2 / denominator;
        } else {
            tangent.corner[k] =
                area2 > denominator || denominator <= 0.0 ? kLargestWeight : 1.0 / kLargestWeight;
            tangent.guarded = true;
        }
    }
    return tangent;
}

double mean_edge(const Mesh& mesh) {
    double sum = 0.0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (const auto& e : edges(mesh, f)) sum += e.norm();
    }
    return mesh.triangle_count() > 0 ? sum / (3.0 * mesh.triangle_count()) : 0.0;
}

/// Collects w(row, column) for rows of free vertices.
class Collector {
public:
    Collector(const std::vector<int>& row_of_vertex, int triangles) : row_(row_of_vertex) {
        entries_.reserve(6 * static_cast<std::size_t>(triangles));
    }
    void add(int i, int j, double weight) {
        const int row = row_[static_cast<std::size_t>(i)];
        if (row >= 0) entries_.emplace_back(row, j, weight);
    }
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(int rows) const {
        Eigen::SparseMatrix<double, Eigen::RowMajor> w(rows, static_cast<Eigen::Index>(row_.size()));
        w.setFromTriplets(entries_.begin(), entries_.end());
        return w;
    }

private:
    const std::vector<int>& row_;
    std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace

const char* name(MapWeights weights) {
    switch (weights) {
        case MapWeights::Cotangent:
            return "cotangent";
        case MapWeights::MeanValue:
            return "mean value";
        case MapWeights::Uniform:
            return "uniform";
    }
    return "";
}

WeightMatrix weight_matrix(const Mesh& mesh, const std::vector<int>& row_of_vertex, int rows,
                           MapWeights weights) {
    Collector collector(row_of_vertex, mesh.triangle_count());
    WeightMatrix result;
    const double shortest = weights == MapWeights::MeanValue ? mean_edge(mesh) / kLargestWeight : 0.0;
    const double unit = mean_edge(mesh);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        Element element{{0.5, 0.5, 0.5}};
        if (weights == MapWeights::Cotangent) element = cotangents(mesh, f);
        if (weights == MapWeights::MeanValue) element = half_tangents(mesh, f);
        bool guarded = element.guarded;
        for (int k = 0; k < 3; ++k) {
            const int i = mesh.F(f, k), j = mesh.F(f, (k + 1) % 3), opposite = (k + 2) % 3;
            double w_ij = element.corner[static_cast<std::size_t>(opposite)], w_ji = w_ij;
            if (weights == MapWeights::MeanValue) {
                const double length = (mesh.V.row(i) - mesh.V.row(j)).norm();
                guarded = guarded || length < shortest;
                // Edges of no length at all in the whole mesh leave the angles alone.
                const double divisor = unit > 0.0 ? std::max(length, shortest) / unit : 1.0;
                w_ij = element.corner[static_cast<std::size_t>(k)] / divisor;
                w_ji = element.corner[static_cast<std::size_t>((k + 1) % 3)] / divisor;
            }
            collector.add(i, j, w_ij);
            collector.add(j, i, w_ji);
        }
        if (guarded) ++result.guarded;
    }
    result.w = collector.matrix(rows);
    if (weights == MapWeights::MeanValue) {
        for (int r = 0; r < rows; ++r) result.w.row(r) /= result.w.row(r).sum();
    }
    return result;
}

}  // namespace automorph
