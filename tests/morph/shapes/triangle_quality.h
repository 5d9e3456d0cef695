#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "morph/mesh/geometry.h"

namespace automorph {

/// Angles in degrees; areas relative to the mean area.
struct TriangleQuality {
    double least_angle = 180.0, largest_angle = 0.0;
    double mean_least_angle = 0.0;  ///< of each triangle's smallest; 60 is perfect
    double least_area, largest_area;
};

inline TriangleQuality triangle_quality(const Mesh& mesh) {
    TriangleQuality quality;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        double least = 180.0;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d p = mesh.V.row(mesh.F(f, k));
            const Eigen::Vector3d u = mesh.V.row(mesh.F(f, (k + 1) % 3)).transpose() - p;
            const Eigen::Vector3d v = mesh.V.row(mesh.F(f, (k + 2) % 3)).transpose() - p;
            const double angle = std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::acos(-1.0);
            least = std::min(least, angle);
            quality.largest_angle = std::max(quality.largest_angle, angle);
        }
        quality.least_angle = std::min(quality.least_angle, least);
        quality.mean_least_angle += least / mesh.triangle_count();
    }
    const Eigen::VectorXd areas = triangle_areas(mesh);
    quality.least_area = areas.minCoeff() / areas.mean();
    quality.largest_area = areas.maxCoeff() / areas.mean();
    return quality;
}

}  // namespace automorph
