#include "morph/registration/coarse_search.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "morph/registration/pose_distance.h"

namespace automorph {

namespace {

using Array = Eigen::ArrayXf;

// Target sample by coordinate, for vector instructions along it.
struct Columns {
    Array x, y, z, nx, ny, nz;

    explicit Columns(const SurfaceSample& sample)
        : x(sample.points.col(0).cast<float>()),
          y(sample.points.col(1).cast<float>()),
          z(sample.points.col(2).cast<float>()),
          nx(sample.normals.col(0).cast<float>()),
          ny(sample.normals.col(1).cast<float>()),
          nz(sample.normals.col(2).cast<float>()) {}
};

// Squared distances of all pairs: column i belongs to source point i.
void all_distances(const Points& moved, const Columns& target, Eigen::ArrayXXf& d2) {
    for (Eigen::Index i = 0; i < moved.rows(); ++i) {
        const Eigen::Vector3f p = moved.row(i).transpose().cast<float>();
        d2.col(i) = (target.x - p.x()).square() + (target.y - p.y()).square() + (target.z - p.z()).square();
    }
}

// One step of EM-ICP: Eq. (7), (6), (5).
RigidMotion em_step(const SurfaceSample& source, const Columns& target, const RigidMotion& motion,
                    Eigen::ArrayXXf& d2, Eigen::VectorXd& weights) {
    const Eigen::Index n = source.size();
    all_distances(motion.apply(source.points), target, d2);
    const Array nearest = d2.colwise().minCoeff();
    const float sigma = nearest.sqrt().mean();
    const float falloff = 1.0f / std::max(2.0f * sigma * sigma, 1e-12f);

    Points expected(n, 3);
    Array p(d2.rows());
    for (Eigen::Index i = 0; i < n; ++i) {
        p = ((nearest[i] - d2.col(i)) * falloff).exp();
        const float sum = p.sum();
        expected.row(i) << (p * target.x).sum() / sum, (p * target.y).sum() / sum, (p * target.z).sum() / sum;
    }
    return weighted_procrustes(source.points, expected, weights);
}

double distance_of(const SurfaceSample& source, const Columns& target, const RigidMotion& motion,
                   bool orientation_is_certain, Eigen::ArrayXXf& d2) {
    all_distances(motion.apply(source.points), target, d2);
    const Points normals = source.normals * motion.R.transpose();
    constexpr auto kWeight = static_cast<float>(kNormalWeight * kNormalWeight);
    double best = 0.0;
    for (const float sign : {1.0f, -1.0f}) {
        if (sign < 0.0f && orientation_is_certain) break;
        Array column(d2.rows()), of_target = Array::Constant(d2.rows(), 1e30f), of_source(d2.cols());
        for (Eigen::Index i = 0; i < d2.cols(); ++i) {
            const Eigen::Vector3f n = sign * normals.row(i).transpose().cast<float>();
            column = d2.col(i) +
                     2.0f * kWeight * (1.0f - n.x() * target.nx - n.y() * target.ny - n.z() * target.nz);
            of_source[i] = column.minCoeff();
            of_target = of_target.min(column);
        }
        const double distance = 0.5 * (trimmed_mean(of_source.max(0.0f).sqrt().cast<double>()) +
                                       trimmed_mean(of_target.max(0.0f).sqrt().cast<double>()));
        best = sign > 0.0f ? distance : std::min(best, distance);
    }
    return best;
}

}  // namespace

std::vector<Candidate> coarse_search(const SurfaceSample& source, const SurfaceSample& target,
                                     const std::vector<Eigen::Matrix3d>& starts,
                                     const CoarseSearchOptions& options) {
    const Columns columns(target);
    std::vector<Candidate> candidates(starts.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, starts.size(), 4), [&](const auto& range) {
        Eigen::ArrayXXf d2(target.size(), source.size());
        Eigen::VectorXd weights = Eigen::VectorXd::Ones(source.size());
        for (std::size_t s = range.begin(); s < range.end(); ++s) {
            RigidMotion motion{starts[s], Eigen::Vector3d::Zero()};
            for (int step = 0; step < options.iterations; ++step) {
                motion = em_step(source, columns, motion, d2, weights);
            }
            candidates[s] = {motion,
                             distance_of(source, columns, motion, options.orientation_is_certain, d2)};
        }
    });
    return candidates;
}

}  // namespace automorph
