#include "morph/overlay/triangulate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

using Eigen::Vector3d;

constexpr int kMaxCorners = 6;

/// One shape as seen from a merged face: its corners and the normal of the triangle that contains it.
struct View {
    std::array<Vector3d, kMaxCorners> corner;
    Vector3d normal;
};

/// 1 for an equilateral triangle that faces along the normal, 0 for one without area, negative if it faces
/// away.
double quality(const View& view, int i, int j, int k) {
    const Vector3d u = view.corner[i] - view.corner[k], v = view.corner[j] - view.corner[k];
    const double sides = u.squaredNorm() + v.squaredNorm() + (u - v).squaredNorm();
    if (!(sides > 0.0)) return 0.0;
    return 2.0 * std::sqrt(3.0) * u.cross(v).dot(view.normal) / sides;
}

Vector3d facet_normal(const Mesh& mesh, int f) {
    return doubled_area_vector(mesh.V, mesh.F, f).normalized();
}

/// The triangulation of a convex polygon with the best worst triangle, by dynamic programming over its
/// chords.
class BestTriangulation {
public:
    BestTriangulation(int corners, const View& a, const View& b) : a_(a), b_(b) {
        for (int length = 2; length < corners; ++length) {
            for (int i = 0; i + length < corners; ++i) solve(i, i + length);
        }
    }

    /// Calls emit(i, j, k) for each triangle of the part between corners i and j.
    template <typename Emit>
    void emit(int i, int j, const Emit& triangle) const {
        if (j - i < 2) return;
        const int k = apex_[i][j];
        triangle(i, k, j);
        emit(i, k, triangle);
        emit(k, j, triangle);
    }

private:
    void solve(int i, int j) {
        worst_[i][j] = -std::numeric_limits<double>::infinity();
        apex_[i][j] = i + 1;
        for (int k = i + 1; k < j; ++k) {
            double q = std::min(quality(a_, i, k, j), quality(b_, i, k, j));
            if (k > i + 1) q = std::min(q, worst_[i][k]);
            if (k < j - 1) q = std::min(q, worst_[k][j]);
            if (q > worst_[i][j]) {
                worst_[i][j] = q;
                apex_[i][j] = k;
            }
        }
    }

    const View& a_;
    const View& b_;
    double worst_[kMaxCorners][kMaxCorners] = {};
    int apex_[kMaxCorners][kMaxCorners] = {};
};

}  // namespace

MergedTriangles triangulate(const Overlay& overlay, const Mesh& a, const Points& points_a, const Mesh& b,
                            const Points& points_b) {
    MergedTriangles result;
    const auto corners_in_all = static_cast<int>(overlay.polygon_vertices.size());
    result.F.resize(corners_in_all - 2 * overlay.face_count(), 3);
    result.face.reserve(static_cast<std::size_t>(result.F.rows()));
    int row = 0;
    for (int f = 0; f < overlay.face_count(); ++f) {
        const auto face = static_cast<std::size_t>(f);
        const int begin = overlay.polygon_start[face], count = overlay.polygon_start[face + 1] - begin;
        assert(count >= 3 && count <= kMaxCorners);
        const int* vertices = overlay.polygon_vertices.data() + begin;
        View view_a{{}, facet_normal(a, overlay.face_of_a[face])},
            view_b{{}, facet_normal(b, overlay.face_of_b[face])};
        for (int i = 0; i < count; ++i) {
            view_a.corner[i] = points_a.row(vertices[i]);
            view_b.corner[i] = points_b.row(vertices[i]);
        }
        BestTriangulation(count, view_a, view_b).emit(0, count - 1, [&](int i, int j, int k) {
            result.F.row(row++) << vertices[i], vertices[j], vertices[k];
            result.face.push_back(f);
        });
    }
    return result;
}

}  // namespace automorph
