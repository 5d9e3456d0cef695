#include "morph/registration/pose_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace automorph {

namespace {

constexpr double kKept = 0.8;  // share of the distances that count
constexpr int kBatch = 1024;   // queries of one task, some milliseconds

NearestPoints<6>::Rows with_normals(const Points& points, const Points& normals, double sign) {
    NearestPoints<6>::Rows rows(points.rows(), 6);
    rows << points, sign * kNormalWeight * normals;
    return rows;
}

// Trimmed mean distance of moved points to a tree.
double one_sided(const SurfaceSample& sample, const RigidMotion& motion, double sign,
                 const NearestPoints<6>& tree, double spacing) {
    const NearestPoints<6>::Rows queries =
        with_normals(motion.apply(sample.points), sample.normals * motion.R.transpose(), sign);
    Eigen::ArrayXd distance(queries.rows());
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, queries.rows(), kBatch), [&](const auto& range) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
            std::uint32_t row;
            double d2;
            tree.query(queries.row(i).data(), 1, &row, &d2);
            const Eigen::Matrix<double, 6, 1> offset = queries.row(i) - tree.points().row(row);
            const Eigen::Vector3d normal = tree.points().row(row).tail<3>() / kNormalWeight;
            const double along = normal.dot(offset.head<3>());
            const double across = (offset.head<3>() - along * normal).norm();
            const double gap = std::max(0.0, across - spacing);
            distance[i] = std::sqrt(along * along + gap * gap + offset.tail<3>().squaredNorm());
        }
    });
    return trimmed_mean(std::move(distance));
}

}  // namespace

double trimmed_mean(Eigen::ArrayXd values) {
    const Eigen::Index kept =
        std::max<Eigen::Index>(1, static_cast<Eigen::Index>(kKept * static_cast<double>(values.size())));
    std::sort(values.begin(), values.end());  // summed in this order, whatever the order of the points
    return values.head(kept).mean();
}

PoseDistance::PoseDistance(const SurfaceSample& source, const SurfaceSample& target)
    : source_(source),
      target_(target),
      source_tree_(with_normals(source.points, source.normals, 1.0)),
      target_tree_(with_normals(target.points, target.normals, 1.0)) {}

double PoseDistance::operator()(const RigidMotion& motion, int probes, double normal_sign) const {
    const RigidMotion back{motion.R.transpose(), -(motion.R.transpose() * motion.t)};
    return 0.5 * (one_sided(thin_out(source_, probes), motion, normal_sign, target_tree_, target_.spacing) +
                  one_sided(thin_out(target_, probes), back, normal_sign, source_tree_, source_.spacing));
}

}  // namespace automorph
