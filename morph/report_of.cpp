#include "morph/report_of.h"

#include <Eigen/Core>

namespace automorph {

RegistrationReport report_of(const Registration& registration, bool used) {
    RegistrationReport report;
    report.used = used;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(report.rotation.data()) = registration.R;
    Eigen::Map<Eigen::Vector3d>(report.translation.data()) = registration.t;
    report.scale = registration.scale;
    report.sigma = registration.sigma;
    report.residual = registration.residual;
    report.runner_up = registration.runner_up;
    report.iterations = registration.iterations;
    report.converged = registration.converged;
    report.confident = registration.confident;
    return report;
}

BorderReport report_of(const BorderUnion& border) {
    return {border.source_size, border.target_size, border.shared, border.size()};
}

MapReport report_of(const std::string& shape, const std::string& weights, const MapQuality& quality) {
    MapReport map;
    map.of = shape;
    map.weights = weights;
    map.flipped = quality.flipped;
    map.p01 = quality.p01;
    map.smallest_ratio = quality.smallest_ratio;
    map.area = {quality.area.median, quality.area.p95, quality.area.worst};
    map.angle = {quality.angle.median, quality.angle.p95, quality.angle.worst};
    return map;
}

MapReport report_of(const std::string& shape, const DiskMap& map) {
    MapReport report = report_of(shape, name(map.weights), map.quality);
    report.reason = map.reason;
    report.residual = map.residual;
    return report;
}

}  // namespace automorph
