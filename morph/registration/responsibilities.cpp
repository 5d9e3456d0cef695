#include <algorithm>
#include <vector>

#include "morph/registration/em_icp.h"
#include "morph/registration/nearest.h"
#include "morph/registration/registration.h"

namespace automorph {

Eigen::SparseMatrix<double, Eigen::RowMajor> responsibilities(const Points& source, const Points& target,
                                                              const Registration& registration,
                                                              int neighbours) {
    Eigen::SparseMatrix<double, Eigen::RowMajor> p(source.rows(), target.rows());
    if (source.rows() == 0 || target.rows() == 0) return p;
    const NearestPoints<3> tree(target);
    const int k = std::clamp(neighbours, 1, tree.size());
    const Points moved = registration.apply(source);

    std::vector<std::uint32_t> column(k);
    std::vector<double> squared_distance(k), row(k);
    p.reserve(Eigen::VectorXi::Constant(source.rows(), k));
    for (Eigen::Index i = 0; i < source.rows(); ++i) {
        tree.query(moved.row(i).data(), k, column.data(), squared_distance.data());
        responsibility_row(squared_distance.data(), k, registration.sigma, row.data());
        for (int j = 0; j < k; ++j) {
            if (row[j] > 0.0) p.insert(i, column[j]) = row[j];
        }
    }
    p.makeCompressed();
    return p;
}

}  // namespace automorph
