#include "morph/alignment/places.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

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
            SurfacePlace& place = places[static_cast<std::size_t>(i)];
            place = closest.query(points.row(i), normal, normal.isZero() ? -2.0 : kAgreement);
            if (!place.found()) place = closest.nearest_facet(points.row(i), normal, kNearInPlace);
        }
    });
    return places;
}

}  // namespace automorph
