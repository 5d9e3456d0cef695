#include "morph/sphere_alignment/smooth_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace automorph {

namespace {

/// Cells per width of the Gaussian, in the middle of a cube face, where an edge of the face is 2 radians
/// long.
constexpr double kCellsPerWidth = 1.5;
/// Exponent below which a place does not count any more.
constexpr double kFar = -8.0;

/// Weight that pulls to zero, as a share of what even weights all over the sphere would give.
constexpr double kRest = 0.02;

constexpr int kFaces = 6;

/// Axis of a face's normal and of its two coordinates; the faces 3 to 5 are those with the negative normals.
struct Face {
    int normal, u, v;
    double sign;
};

Face face(int index) {
    return {index % 3, (index + 1) % 3, (index + 2) % 3, index < 3 ? 1.0 : -1.0};
}

}  // namespace

SmoothField::SmoothField(const Points& places, const Points& vectors, const Eigen::VectorXd& weights,
                         double width) {
    cells_ = std::max(1, static_cast<int>(std::ceil(2.0 * kCellsPerWidth / width)));
    const int nodes = cells_ + 1;
    nodes_.assign(static_cast<std::size_t>(kFaces * nodes * nodes), Eigen::Vector3d::Zero());
    const double sharpness =
        1.0 / (width * width);  // exp(-angle^2 / 2 width^2) is about exp((cosine - 1) sharpness)
    const double rest = kRest * weights.sum() * 0.5 * width * width;
    tbb::parallel_for(0, kFaces * nodes, [&](int row) {
        const Face f = face(row / nodes);
        for (int j = 0; j < nodes; ++j) {
            Eigen::Vector3d x;
            x[f.normal] = f.sign;
            x[f.u] = 2.0 * (row % nodes) / cells_ - 1.0;
            x[f.v] = 2.0 * j / cells_ - 1.0;
            x.normalize();
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            double total = rest;
            for (Eigen::Index k = 0; k < places.rows(); ++k) {
                const double cosine = places(k, 0) * x[0] + places(k, 1) * x[1] + places(k, 2) * x[2];
                const double exponent = (cosine - 1.0) * sharpness;
                if (exponent < kFar) continue;
                const double weight = weights[k] * std::exp(exponent);
                sum += weight * Eigen::Vector3d(vectors(k, 0), vectors(k, 1), vectors(k, 2));
                total += weight;
            }
            if (total > 0.0) nodes_[static_cast<std::size_t>(row * nodes + j)] = sum / total;
        }
    });
}

Eigen::Vector3d SmoothField::operator()(const Eigen::Vector3d& unit) const {
    int axis = 0;
    unit.cwiseAbs().maxCoeff(&axis);
    const int index = unit[axis] > 0.0 ? axis : axis + 3;
    const Face f = face(index);
    const double height = std::abs(unit[axis]);
    const double u = 0.5 * cells_ * (unit[f.u] / height + 1.0), v = 0.5 * cells_ * (unit[f.v] / height + 1.0);
    const int i = std::clamp(static_cast<int>(u), 0, cells_ - 1),
              j = std::clamp(static_cast<int>(v), 0, cells_ - 1);
    const double s = u - i, t = v - j;
    const int nodes = cells_ + 1;
    const auto node = [&](int row, int column) -> const Eigen::Vector3d& {
        return nodes_[static_cast<std::size_t>((index * nodes + row) * nodes + column)];
    };
    return (1.0 - s) * ((1.0 - t) * node(i, j) + t * node(i, j + 1)) +
           s * ((1.0 - t) * node(i + 1, j) + t * node(i + 1, j + 1));
}

}  // namespace automorph
