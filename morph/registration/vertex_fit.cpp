#include "morph/registration/vertex_fit.h"

#include "morph/registration/nearest.h"
#include "morph/registration/neighbourhoods.h"

namespace automorph {

namespace {

constexpr int kMostRounds = 10;
constexpr double kClose = 0.02, kCoincident = 1e-6;  // mean distance, in units of the shapes' size
constexpr Eigen::Index kMostQueries = 20000;

}  // namespace

RigidMotion settled_on_vertices(const Points& source, const Points& target, const RigidMotion& start) {
    if (source.rows() != target.rows()) return start;
    const NearestPoints<3> tree(target);
    Neighbourhoods near(tree, source.rows(), 1);
    RigidMotion motion = start;
    for (int round = 0; round < kMostRounds; ++round) {
        near.find(motion.apply(source));
        const double mean = near.sigma();
        if (mean > kClose) return start;
        motion =
            weighted_procrustes(source, near.expected(target, 0.0), Eigen::VectorXd::Ones(source.rows()));
        if (mean < kCoincident) return motion;
    }
    return start;
}

double mean_nearest_distance(const Points& moved, const Points& target) {
    const NearestPoints<3> tree(target);
    const Eigen::Index stride = (moved.rows() + kMostQueries - 1) / kMostQueries;
    const Points asked = moved(Eigen::seq(0, moved.rows() - 1, stride), Eigen::all);
    Neighbourhoods near(tree, asked.rows(), 1);
    near.find(asked);
    return near.sigma();
}

}  // namespace automorph
