#include "morph/registration/nearest.h"

#include <cassert>
#include <nanoflann.hpp>
#include <utility>

namespace automorph {

namespace {

constexpr std::size_t kLeafSize = 12;  // points per leaf; 8 to 20 are equally fast

}  // namespace

template <int Dim>
struct NearestPoints<Dim>::Tree {
    // What nanoflann asks of a point set.
    struct Set {
        Rows rows;

        std::size_t kdtree_get_point_count() const { return static_cast<std::size_t>(rows.rows()); }
        double kdtree_get_pt(std::size_t row, std::size_t column) const {
            return rows(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
        }
        template <class Box>
        bool kdtree_get_bbox(Box&) const {
            return false;  // nanoflann computes it
        }
    };
    // The index type is spelled out: query() hands nanoflann an array of it.
    using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Set>, Set, Dim,
                                                      std::uint32_t>;
    explicit Tree(Rows points)
        : set{std::move(points)}, index(Dim, set, nanoflann::KDTreeSingleIndexAdaptorParams(kLeafSize)) {}

    Set set;
    Index index;
};

template <int Dim>
NearestPoints<Dim>::NearestPoints(Rows points) : tree_(std::make_unique<Tree>(std::move(points))) {}
template <int Dim>
NearestPoints<Dim>::~NearestPoints() = default;
template <int Dim>
NearestPoints<Dim>::NearestPoints(NearestPoints&&) noexcept = default;
template <int Dim>
NearestPoints<Dim>& NearestPoints<Dim>::operator=(NearestPoints&&) noexcept = default;

template <int Dim>
const typename NearestPoints<Dim>::Rows& NearestPoints<Dim>::points() const {
    return tree_->set.rows;
}

template <int Dim>
void NearestPoints<Dim>::query(const double* query, int k, std::uint32_t* rows,
                               double* squared_distances) const {
    assert(k >= 1 && k <= size());
    tree_->index.knnSearch(query, static_cast<std::size_t>(k), rows, squared_distances);
}

template class NearestPoints<3>;
template class NearestPoints<6>;

}  // namespace automorph
