#include "morph/registration/neighbourhoods.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace automorph {

namespace {

// Points per task, a millisecond's work. Finer tasks cost more in meeting again than they gain, above all on
// a busy machine; candidates and starts are refined side by side anyway.
constexpr int kGrain = 1024;

}  // namespace

Neighbourhoods::Neighbourhoods(const NearestPoints<3>& target, Eigen::Index source_count, int neighbours)
    : tree_(target),
      source_count_(source_count),
      k_(std::clamp(neighbours, 1, target.size())),
      known_(std::min(2 * k_, target.size())),
      looked_up_at_(Points::Constant(source_count, 3, std::numeric_limits<double>::infinity())),
      radius_(Eigen::VectorXd::Zero(source_count)),
      target_(source_count * known_),
      squared_distance_(source_count * known_) {}

void Neighbourhoods::find(const Points& moved) {
    assert(moved.rows() == source_count_);
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, source_count_, kGrain), [&](const auto& range) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
            if (!reorder_known(i, moved.row(i))) look_up(i, moved.row(i));
        }
    });
}

void Neighbourhoods::look_up(Eigen::Index i, const Eigen::RowVector3d& point) {
    const Eigen::Index first = i * known_;
    tree_.query(point.data(), known_, &target_[first], &squared_distance_[first]);
    looked_up_at_.row(i) = point;
    radius_[i] = known_ == tree_.size() ? std::numeric_limits<double>::infinity()
                                        : std::sqrt(squared_distance_[first + known_ - 1]);
}

bool Neighbourhoods::reorder_known(Eigen::Index i, const Eigen::RowVector3d& point) {
    const double unseen = radius_[i] - (point - looked_up_at_.row(i)).norm();  // no other target is nearer
    if (!(unseen > 0.0)) return false;
    // Insertion sort: the order hardly changes from step to step.
    std::uint32_t* target = &target_[i * known_];
    double* squared_distance = &squared_distance_[i * known_];
    for (int j = 0; j < known_; ++j) {
        const std::uint32_t row = target[j];
        const double d2 = (tree_.points().row(row) - point).squaredNorm();
        int place = j;
        for (; place > 0 && squared_distance[place - 1] > d2; --place) {
            target[place] = target[place - 1];
            squared_distance[place] = squared_distance[place - 1];
        }
        target[place] = row;
        squared_distance[place] = d2;
    }
    return squared_distance[k_ - 1] < unseen * unseen;
}

double Neighbourhoods::sigma() const {
    double sum = 0.0;  // in order, so that the number of threads does not show
    for (Eigen::Index i = 0; i < source_count_; ++i) sum += std::sqrt(squared_distance_[i * known_]);
    return sum / static_cast<double>(source_count_);
}

Points Neighbourhoods::expected(const Points& y, double sigma) const {
    Points mean = Points::Zero(source_count_, 3);
    std::vector<double> p(k_);
    for (Eigen::Index i = 0; i < source_count_; ++i) {
        responsibility_row(&squared_distance_[i * known_], k_, sigma, p.data());
        for (int j = 0; j < k_; ++j) mean.row(i) += p[j] * y.row(target_[i * known_ + j]);
    }
    return mean;
}

void responsibility_row(const double* squared_distances, int k, double sigma, double* p) {
    const double scale = 2.0 * sigma * sigma;
    double sum = 0.0;
    // Two at a time by Eigen's exponential: the C library's gives other bits on other processors.
    for (int j = 0; j < k; j += 2) {
        const bool pair = j + 1 < k;
        const Eigen::Array2d farther(squared_distances[j] - squared_distances[0],
                                     pair ? squared_distances[j + 1] - squared_distances[0] : 0.0);
        const Eigen::Array2d exponential = scale > 0.0 ? Eigen::Array2d((-farther / scale).exp())
                                                       : Eigen::Array2d((farther <= 0.0).cast<double>());
        p[j] = exponential[0];
        if (pair) p[j + 1] = exponential[1];
        sum += exponential[0] + (pair ? exponential[1] : 0.0);
    }
    for (int j = 0; j < k; ++j) p[j] /= sum;
}

}  // namespace automorph
