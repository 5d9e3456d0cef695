#include "morph/parameterization/repair_map.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "morph/exact/predicates.h"
#include "morph/parameterization/map_quality.h"

namespace automorph {

namespace {

using Point = Eigen::Vector2d;

/// Rounds without progress after which the repair gives up; the region grows by one ring in each of them.
constexpr int kStalledRounds = 12;
constexpr int kMostRounds = 400;

double turn(const Point& a, const Point& b, const Point& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Triangles about each vertex.
class Stars {
public:
    Stars(const Triangles& F, int vertex_count)
        : F_(F), start_(static_cast<std::size_t>(vertex_count) + 1, 0) {
        for (int f = 0; f < F.rows(); ++f) {
            for (int k = 0; k < 3; ++k) ++start_[static_cast<std::size_t>(F(f, k)) + 1];
        }
        for (std::size_t v = 1; v < start_.size(); ++v) start_[v] += start_[v - 1];
        triangles_.resize(3 * static_cast<std::size_t>(F.rows()));
        std::vector<int> next(start_.begin(), start_.end() - 1);
        for (int f = 0; f < F.rows(); ++f) {
            for (int k = 0; k < 3; ++k)
                triangles_[static_cast<std::size_t>(next[static_cast<std::size_t>(F(f, k))]++)] = f;
        }
    }

    const int* begin(int v) const { return triangles_.data() + start_[static_cast<std::size_t>(v)]; }
    const int* end(int v) const { return triangles_.data() + start_[static_cast<std::size_t>(v) + 1]; }

    /// The edge opposite v in triangle f, counter-clockwise seen from v.
    std::pair<int, int> opposite(int f, int v) const {
        const int k = F_(f, 0) == v ? 0 : F_(f, 1) == v ? 1 : 2;
        return {F_(f, (k + 1) % 3), F_(f, (k + 2) % 3)};
    }

private:
    const Triangles& F_;
    std::vector<int> start_, triangles_;
};

class Repair {
public:
    Repair(const Mesh& mesh, const std::vector<char>& fixed, const Points& rays)
        : F_(mesh.F), fixed_(fixed), rays_(rays), stars_(mesh.F, mesh.vertex_count()) {}

    void run();
    const Points& rays() const { return rays_; }

private:
    bool flipped(int f) const {
        return orientation(rays_.row(F_(f, 0)), rays_.row(F_(f, 1)), rays_.row(F_(f, 2))) <= 0;
    }
    int flips_about(int v) const {
        return static_cast<int>(
            std::count_if(stars_.begin(v), stars_.end(v), [this](int f) { return flipped(f); }));
    }
    std::vector<int> region(const std::vector<int>& bad, int rings) const;
    std::optional<Point> kernel_centre(int v) const;
    Point mean_of_neighbours(int v) const;
    bool try_move(int v, const Point& place);

    const Triangles& F_;
    const std::vector<char>& fixed_;
    Points rays_;
    Stars stars_;
};

/// Free corners of the bad triangles and `rings` rings about them, by index.
std::vector<int> Repair::region(const std::vector<int>& bad, int rings) const {
    std::vector<int> vertices;
    for (const int f : bad) vertices.insert(vertices.end(), {F_(f, 0), F_(f, 1), F_(f, 2)});
    for (int ring = 0;; ++ring) {
        std::sort(vertices.begin(), vertices.end());
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        if (ring == rings) break;
        const std::size_t count = vertices.size();
        for (std::size_t k = 0; k < count; ++k) {
            const int v = vertices[k];
            for (const int* f = stars_.begin(v); f != stars_.end(v); ++f) {
                const auto [p, q] = stars_.opposite(*f, v);
                vertices.insert(vertices.end(), {p, q});
            }
        }
    }
    std::erase_if(vertices, [this](int v) { return fixed_[static_cast<std::size_t>(v)] != 0; });
    return vertices;
}

/// Mean of the corners of the kernel of v's star: the ring's bounding square clipped by all its edges, in
/// coordinates about v.
std::optional<Point> Repair::kernel_centre(int v) const {
    const Point origin = rays_.row(v).head<2>();
    std::vector<std::pair<Point, Point>> ring;
    Point low = Point::Zero(), high = Point::Zero();
    for (const int* f = stars_.begin(v); f != stars_.end(v); ++f) {
        const auto [p, q] = stars_.opposite(*f, v);
        ring.emplace_back(rays_.row(p).head<2>().transpose() - origin,
                          rays_.row(q).head<2>().transpose() - origin);
        low = low.cwiseMin(ring.back().first);
        high = high.cwiseMax(ring.back().first);
    }
    std::vector<Point> kernel{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, clipped;
    for (const auto& [p, q] : ring) {
        clipped.clear();
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            const Point &a = kernel[k], &b = kernel[(k + 1) % kernel.size()];
            const double side_a = turn(p, q, a), side_b = turn(p, q, b);
            if (side_a >= 0) clipped.push_back(a);
            if ((side_a > 0 && side_b < 0) || (side_a < 0 && side_b > 0)) {
                clipped.push_back(a + side_a / (side_a - side_b) * (b - a));
            }
        }
        kernel.swap(clipped);
        if (kernel.size() < 3) return std::nullopt;
    }
    Point mean = Point::Zero();
    for (const Point& corner : kernel) mean += corner / static_cast<double>(kernel.size());
    return origin + mean;
}

Point Repair::mean_of_neighbours(int v) const {
    Point sum = Point::Zero();
    int count = 0;
    for (const int* f = stars_.begin(v); f != stars_.end(v); ++f, ++count) {
        sum += rays_.row(stars_.opposite(*f, v).first).head<2>().transpose();
    }
    return count > 0 ? Point(sum / count) : Point(rays_.row(v).head<2>());
}

/// Moves v unless that flips more triangles of its star than before.
bool Repair::try_move(int v, const Point& place) {
    const Eigen::RowVector3d before = rays_.row(v);
    if (before.head<2>() == place.transpose()) return false;
    const int flips = flips_about(v);
    rays_.row(v).head<2>() = place.transpose();
    if (flips_about(v) <= flips) return true;
    rays_.row(v) = before;
    return false;
}

void Repair::run() {
    std::vector<int> bad;
    for (int f = 0; f < F_.rows(); ++f) {
        if (flipped(f)) bad.push_back(f);
    }
    std::size_t fewest = bad.size();
    for (int round = 0, stalled = 0; !bad.empty() && stalled < kStalledRounds && round < kMostRounds;
         ++round) {
        const std::vector<int> vertices = region(bad, stalled);
        for (const int v : vertices) {
            const auto centre = kernel_centre(v);
            if (!centre || !try_move(v, *centre)) try_move(v, mean_of_neighbours(v));
        }
        // Only triangles about moved vertices can have changed.
        for (const int v : vertices) bad.insert(bad.end(), stars_.begin(v), stars_.end(v));
        std::sort(bad.begin(), bad.end());
        bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
        std::erase_if(bad, [this](int f) { return !flipped(f); });
        stalled = bad.size() < fewest ? 0 : stalled + 1;
        fewest = std::min(fewest, bad.size());
    }
}

}  // namespace

RepairedMap repair_map(const Mesh& mesh, const std::vector<char>& fixed, const Points& rays) {
    Repair repair(mesh, fixed, rays);
    repair.run();
    RepairedMap result{repair.rays(), flipped_triangles(mesh.F, repair.rays()), 0};
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (result.rays.row(v) != rays.row(v)) ++result.moved;
    }
    return result;
}

}  // namespace automorph
