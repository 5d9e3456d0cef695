#include "render/figure/color_field.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "morph/features/curvature.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/half_edge_table.h"
#include "morph/registration/procrustes.h"

namespace automorph {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Eigen::VectorXd mean_curvature(const Mesh& frame) {
    constexpr double kWidth = 0.02;  // of the smoothing, relative to the root of the area
    const HalfEdgeTable half_edges(frame.F, frame.vertex_count());
    const Curvature smooth = smoothed(curvature(frame, half_edges), frame, kWidth);
    Eigen::VectorXd values = smooth.mean, sums = Eigen::VectorXd::Zero(frame.vertex_count()), counts = sums;
    // Edges at an inner vertex have two half-edges, so each of its neighbours is met.
    for (int h = 0; h < half_edges.count(); ++h) {
        const int from = half_edges.from(h), to = half_edges.to(h);
        if (!smooth[from]) continue;
        sums[to] += smooth.mean[from];
        ++counts[to];
    }
    for (int v = 0; v < frame.vertex_count(); ++v) {
        if (!smooth[v]) values[v] = counts[v] > 0 ? sums[v] / counts[v] : kNaN;
    }
    return values;
}

Eigen::VectorXd displacement(const Mesh& source, const Points& frame) {
    const RigidMotion motion = weighted_procrustes(source.V, frame, vertex_areas(source));
    return (frame - motion.apply(source.V)).rowwise().norm();
}

/// A triangle laid into the plane: its edges from the first corner, as columns.
Eigen::Matrix2d flat(const Points& V, const Eigen::RowVector3i& f) {
    const Eigen::Vector3d a = V.row(f[1]) - V.row(f[0]), b = V.row(f[2]) - V.row(f[0]);
    const double length = a.norm();
    const double along = length > 0 ? a.dot(b) / length : 0;
    const double across = std::sqrt(std::max(0.0, b.squaredNorm() - along * along));
    Eigen::Matrix2d edges;
    edges << length, along, 0, across;
    return edges;
}

/// max(s1, 1 / s2) of the map between two triangles. @pre the first has area
double stretch(const Eigen::Matrix2d& from, const Eigen::Matrix2d& to) {
    constexpr double kMost = 100;  // a triangle that collapses must not drown its neighbours
    Eigen::Matrix2d inverse;
    inverse << from(1, 1), -from(0, 1), 0, from(0, 0);
    inverse /= from(0, 0) * from(1, 1);
    const Eigen::Matrix2d map = to * inverse;
    const double sum = 0.5 * map.squaredNorm(), product = map(0, 0) * map(1, 1) - map(0, 1) * map(1, 0);
    const double root = std::sqrt(std::max(0.0, sum * sum - product * product));
    const double largest = std::sqrt(sum + root);
    const double smallest = largest > 0 ? std::abs(product) / largest : 0;
    return std::min(kMost, std::max(largest, smallest > 0 ? 1 / smallest : kMost));
}

Eigen::VectorXd distortion(const Mesh& source, const Points& frame) {
    const Eigen::VectorXd areas = triangle_areas(source);
    const double least = 1e-12 * areas.maxCoeff();  // slivers of the overlay whose shape is rounding
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(source.V.rows()), weights = sums;
    for (Eigen::Index f = 0; f < source.F.rows(); ++f) {
        const Eigen::Matrix2d from = flat(source.V, source.F.row(f));
        if (!(areas[f] > least) || !(from(0, 0) * from(1, 1) > 0)) continue;
        const double value = stretch(from, flat(frame, source.F.row(f)));
        for (int k = 0; k < 3; ++k) {
            sums[source.F(f, k)] += areas[f] * value;
            weights[source.F(f, k)] += areas[f];
        }
    }
    return (weights.array() > 0).select(sums.array() / weights.array(), kNaN).matrix();
}

/// Rounded to two digits.
double rounded(double value) {
    if (value == 0 || !std::isfinite(value)) return 0;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 1);
    return std::round(value / unit) * unit;
}

/// The value below which a share of them lies; 0 of none.
double percentile(std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    const auto place =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

}  // namespace

std::vector<Eigen::VectorXd> color_field(ColorField field, const FrameSequence& sequence) {
    std::vector<Eigen::VectorXd> values;
    const Mesh source{sequence.source, sequence.triangles};
    for (const Points& frame : sequence.frames) values.push_back(color_field(field, source, frame));
    return values;
}

Eigen::VectorXd color_field(ColorField field, const Mesh& source, const Points& frame) {
    if (field == ColorField::Curvature) return mean_curvature({frame, source.F});
    if (field == ColorField::Displacement) return displacement(source, frame);
    return distortion(source, frame);
}

ColorScale color_scale(ColorField field, const std::vector<std::vector<Eigen::VectorXd>>& values) {
    std::vector<double> all;
    for (const std::vector<Eigen::VectorXd>& row : values) {
        for (const Eigen::VectorXd& frame : row) {
            std::copy_if(frame.begin(), frame.end(), std::back_inserter(all),
                         [](double value) { return std::isfinite(value); });
        }
    }
    constexpr double kTail = 0.02;
    ColorScale scale{0, rounded(percentile(all, 1 - kTail)), ""};
    switch (field) {
        case ColorField::Curvature:
            scale.low = rounded(percentile(all, kTail));
            scale.meaning = "mean curvature \u00d7 \u221aarea (a sphere has 3.5)";
            break;
        case ColorField::Displacement:
            scale.meaning = "displacement after rigid alignment, scene units";
            break;
        case ColorField::Distortion:
            scale.low = 1;
            scale.meaning = "largest stretch or shrinkage (1: none)";
            break;
        case ColorField::None:
            break;
    }
    scale.high = std::max(scale.high, scale.low);
    return scale;
}

}  // namespace automorph
