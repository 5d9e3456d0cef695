#include "morph/alignment/places.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <limits>

#include "morph/mesh/geometry.h"
#include "morph/registration/nearest.h"

namespace automorph {

namespace {

constexpr double kAgreement = 0.3;     // cosine
constexpr double kNearInPlace = 0.03;  // of the diagonal: as different as normals at right angles

}  // namespace

std::vector<SurfacePlace> places_on(const Mesh& target, const Points& points, const Points& normals) {
    const ClosestPoints closest(target);
    std::vector<SurfacePlace> places(static_cast<std::size_t>(points.rows()));
    tbb::parallel_for(tbb::blocked_range<Eigen::Index>(0, points.rows(), 256), [&](const auto& range) {
        for (Eigen::Index i = range.begin(); i < range.end(); ++i) {
            const Eigen::Vector3d normal = normals.row(i);
            places[static_cast<std::size_t>(i)] =
                closest.query(points.row(i), normal, normal.isZero() ? -2.0 : kAgreement);
        }
    });
    // Rare: deep in a fold of the target.
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        SurfacePlace& place = places[static_cast<std::size_t>(i)];
        if (place.found()) continue;
        const double scale = kNearInPlace * bounding_box_diagonal(target.V);
        double least = std::numeric_limits<double>::infinity();
        for (int f = 0; f < target.triangle_count(); ++f) {
            const Eigen::RowVector3d a = target.V.row(target.F(f, 0)), b = target.V.row(target.F(f, 1)),
                                     c = target.V.row(target.F(f, 2));
            const Eigen::RowVector3d n = (b - a).cross(c - a).stableNormalized();
            const double distance = ((a + b + c) / 3.0 - points.row(i)).squaredNorm() / (scale * scale) +
                                    (n - normals.row(i)).squaredNorm();
            if (distance < least) {
                least = distance;
                place = {{target.F(f, 0), target.F(f, 1), target.F(f, 2)},
                         Eigen::Vector3d::Constant(1.0 / 3.0)};
            }
        }
    }
    return places;
}

}  // namespace automorph
