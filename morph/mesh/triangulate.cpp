#include "morph/mesh/triangulate.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <unordered_set>

namespace automorph {

namespace {

using EdgeSet = std::unordered_set<std::uint64_t>;

std::uint64_t edge_key(int a, int b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint32_t>(std::max(a, b));
}

/// Cuts ears off one polygon.
class EarCutter {
public:
    EarCutter(const Points& V, const std::vector<int>& corners, EdgeSet& edges)
        : corners_(corners), edges_(edges), size_(static_cast<int>(corners.size())), left_(size_) {
        for (const int v : corners) points_.emplace_back(V.row(v));
        const Eigen::Vector3d origin = points_[0];
        for (Eigen::Vector3d& p : points_) p -= origin;
        for (int i = 0; i < size_; ++i) normal_ += points_[i].cross(points_[(i + 1) % size_]);
        if (normal_.norm() > 0.0) normal_.normalize();
        for (int i = 0; i < size_; ++i) {
            next_.push_back((i + 1) % size_);
            previous_.push_back((i + size_ - 1) % size_);
        }
        scores_.assign(corners.size(), kCut);
        convex_.assign(corners.size(), 0);
        for (int i = 0; i < size_; ++i) convex_[i] = quality(previous_[i], i, next_[i]) > 0.0;
        for (int i = 0; i < size_; ++i) scores_[i] = score(i);
    }

    template <class Emit>
    void cut(Emit emit) {
        for (; left_ > 3; --left_) {
            if (left_ == 4) {  // two ears share a diagonal: what matters is the worse of both triangles
                for (int i = 0; i < size_; ++i) {
                    if (scores_[i] != kCut) scores_[i] = score(i);
                }
            }
            const int ear =
                static_cast<int>(std::max_element(scores_.begin(), scores_.end()) - scores_.begin());
            const int p = previous_[ear], n = next_[ear];
            emit(corners_[p], corners_[ear], corners_[n]);
            edges_.insert(edge_key(corners_[p], corners_[n]));
            scores_[ear] = kCut;
            next_[p] = n;
            previous_[n] = p;
            first_ = p;
            for (const int i : {p, n}) convex_[i] = quality(previous_[i], i, next_[i]) > 0.0;
            for (const int i : {p, n}) scores_[i] = score(i);
        }
        emit(corners_[previous_[first_]], corners_[first_], corners_[next_[first_]]);
    }

private:
    static constexpr double kCut = -1e9;

    /// Twice the signed area in the polygon's plane.
    double turn(int a, int b, int c) const {
        return (points_[b] - points_[a]).cross(points_[c] - points_[a]).dot(normal_);
    }

    /// From -1 to 1: 1 for an equilateral triangle in the polygon's plane, negative if it faces the other
    /// way.
    double quality(int a, int b, int c) const {
        const double edges = (points_[b] - points_[a]).squaredNorm() +
                             (points_[c] - points_[b]).squaredNorm() +
                             (points_[a] - points_[c]).squaredNorm();
        constexpr double kEquilateral = 3.4641016151377544;  // 2 sqrt(3)
        return edges > 0.0 ? kEquilateral * turn(a, b, c) / edges : 0.0;
    }

    bool blocked(int ear) const {
        const int p = previous_[ear], n = next_[ear];
        for (int i = next_[n]; i != p; i = next_[i]) {
            if (convex_[i]) continue;
            if (points_[i] == points_[p] || points_[i] == points_[ear] || points_[i] == points_[n]) continue;
            if (turn(p, ear, i) >= 0.0 && turn(ear, n, i) >= 0.0 && turn(n, p, i) >= 0.0) return true;
        }
        return false;
    }

    /// Good ears are positive; the less an ear may be used, the lower it comes.
    double score(int ear) const {
        const int p = previous_[ear], n = next_[ear];
        double value = quality(p, ear, n);
        if (left_ == 4) value = std::min(value, quality(p, n, next_[n]));
        if (value > 0.0 && blocked(ear)) value -= 2.0;
        if (corners_[p] == corners_[n]) value -= 16.0;
        if (edges_.count(edge_key(corners_[p], corners_[n])) > 0) value -= 8.0;
        return value;
    }

    const std::vector<int>& corners_;
    EdgeSet& edges_;
    int size_, left_, first_ = 0;
    Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
    std::vector<Eigen::Vector3d> points_;
    std::vector<int> next_, previous_;
    std::vector<double> scores_;
    std::vector<char> convex_;
};

/// The corners of a polygon without repetitions in a row.
void corners_of(const PolygonSoup& soup, int polygon, std::vector<int>& corners) {
    corners.clear();
    for (int i = soup.polygon_start[polygon]; i < soup.polygon_start[polygon + 1]; ++i) {
        const int v = soup.polygon_vertices[i];
        if (corners.empty() || corners.back() != v) corners.push_back(v);
    }
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
}

}  // namespace

TriangulatedSoup triangulate(const PolygonSoup& soup) {
    TriangulatedSoup result;
    std::vector<int> corners, flat;
    EdgeSet edges;
    const auto emit = [&](int polygon, int a, int b, int c) {
        if (a == b || b == c || c == a) {
            ++result.degenerate;
            return;
        }
        flat.insert(flat.end(), {a, b, c});
        result.polygon.push_back(polygon);
    };
    const int polygons = soup.polygon_count();
    bool all_triangles = true;
    for (int p = 0; p < polygons && all_triangles; ++p) {
        all_triangles = soup.polygon_start[p + 1] - soup.polygon_start[p] <= 3;
    }
    for (int p = 0; p < polygons && !all_triangles; ++p) {
        corners_of(soup, p, corners);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            edges.insert(edge_key(corners[i], corners[(i + 1) % corners.size()]));
        }
    }
    for (int p = 0; p < polygons; ++p) {
        const int size = soup.polygon_start[p + 1] - soup.polygon_start[p];
        corners_of(soup, p, corners);
        if (size < 3) {
            ++result.too_small;
        } else if (corners.size() < 3) {
            ++result.degenerate;
        } else if (corners.size() == 3) {
            emit(p, corners[0], corners[1], corners[2]);
        } else if (corners.size() > kLargestPolygon) {
            result.too_large = p;
            for (std::size_t i = 2; i < corners.size(); ++i) emit(p, corners[0], corners[i - 1], corners[i]);
        } else {
            ++result.split_polygons;
            EarCutter(soup.V, corners, edges).cut([&](int a, int b, int c) { emit(p, a, b, c); });
        }
    }
    result.F = Eigen::Map<const Triangles>(flat.data(), static_cast<Eigen::Index>(flat.size() / 3), 3);
    return result;
}

}  // namespace automorph
