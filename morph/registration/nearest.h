#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

namespace automorph {

/// k-d tree over the rows of a matrix: the one door to nanoflann. Queries may run from several threads.
/// Dim is 3 (positions) or 6 (positions with scaled normals).
template <int Dim>
class NearestPoints {
public:
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Dim, Eigen::RowMajor>;

    explicit NearestPoints(Rows points);
    ~NearestPoints();
    NearestPoints(NearestPoints&&) noexcept;
    NearestPoints& operator=(NearestPoints&&) noexcept;

    const Rows& points() const;
    int size() const { return static_cast<int>(points().rows()); }

    /// The k <= size() rows nearest to `query` (Dim numbers), nearest first, with their squared distances.
    void query(const double* query, int k, std::uint32_t* rows, double* squared_distances) const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

extern template class NearestPoints<3>;
extern template class NearestPoints<6>;

}  // namespace automorph
