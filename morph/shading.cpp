#include "morph/shading.h"

#include "morph/mesh/geometry.h"
#include "morph/overlay/lift.h"

namespace automorph {

namespace {

/// Degrees a triangle may face away from a vertex' normal; those at the corners of a cube do by 55. Lids and
/// lips of scans are rounder.
constexpr double kShadingCrease = 50.0;

/// Of the surface without what fills its openings.
Points own_normals(const Shape& shape) {
    Mesh own = shape.mesh;
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < own.F.rows(); ++f) {
        if (own.F.row(f).maxCoeff() < shape.own_vertices) own.F.row(kept++) = own.F.row(f).eval();
    }
    own.F.conservativeResize(kept, 3);
    return smooth_normals(own, kShadingCrease);
}

}  // namespace

Points shading_correction(const Shape& shape, const std::vector<Site>& sites, const Points& points,
                          const Triangles& F) {
    const Points normals = own_normals(shape);
    Points correction = -area_weighted_normals(points, F);
    for (std::size_t k = 0; k < sites.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        Eigen::RowVector3d n = Eigen::RowVector3d::Zero();
        bool smooth = true;
        for (int i = 0; i < sites[k].count; ++i) {
            smooth = smooth && !normals.row(sites[k].corners[i]).isZero(0.0);
            n += sites[k].weights[i] * normals.row(sites[k].corners[i]);
        }
        if (smooth) {
            correction.row(row) += n.stableNormalized();
        } else {
            correction.row(row).setZero();
        }
    }
    return correction;
}

}  // namespace automorph
