#include "morph/features/warp.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "morph/exact/predicates.h"
#include "morph/features/plane_grid.h"
#include "morph/mesh/half_edge_table.h"

// Notation of [Urtasun04] Sec. 4.3: h_j vertices in the map, f_i features, w_i their places, d the reach.

namespace automorph {

namespace {

using Eigen::Vector2d;

/// Largest slope of a move.
constexpr double kSlope = 0.5;
/// A move is halved no more often: a millionth of a move is none.
constexpr int kHalvings = 20;
/// A loop that takes less than this share off the sum of distances is one that leaves all as it is.
constexpr double kProgress = 0.01;

class Warper {
public:
    Warper(const Mesh& mesh, const std::vector<int>& loop, const Points& rays,
           const std::vector<int>& features, const Points& places, const WarpOptions& options)
        : half_edges_(mesh.F, mesh.vertex_count()),
          features_(features),
          places_(places),
          options_(options),
          checked_(static_cast<std::size_t>(mesh.triangle_count()), 0) {
        result_.rays = rays;
        std::vector<char> fixed(static_cast<std::size_t>(mesh.vertex_count()), 0);
        for (const int v : loop) fixed[static_cast<std::size_t>(v)] = 1;
        for (int v = 0; v < mesh.vertex_count(); ++v)
            if (!fixed[static_cast<std::size_t>(v)]) inner_.push_back(v);
        for ([[maybe_unused]] const int v : features) assert(!fixed[static_cast<std::size_t>(v)]);
    }

    WarpedMap run() {
        for (double d = options_.reach; d >= options_.least_reach && !all_in_place(); d *= options_.shrink) {
            result_.reach = d;
            PlaneGrid grid(result_.rays, inner_, d);
            loop_until_still(grid, d);
        }
        set_exactly();
        for (int i = 0; i < count(); ++i) {
            result_.distances.push_back(distance(i));
            result_.in_place += in_place(i);
        }
        return std::move(result_);
    }

private:
    int count() const { return static_cast<int>(features_.size()); }
    Vector2d position(int v) const { return result_.rays.row(v).head<2>(); }
    Vector2d place(int i) const { return places_.row(i).head<2>(); }
    double distance(int i) const {
        return (place(i) - position(features_[static_cast<std::size_t>(i)])).norm();
    }
    bool in_place(int i) const { return distance(i) <= options_.tolerance; }
    bool all_in_place() const {
        for (int i = 0; i < count(); ++i)
            if (!in_place(i)) return false;
        return true;
    }
    double sum_of_distances() const {
        double sum = 0.0;
        for (int i = 0; i < count(); ++i) sum += distance(i);
        return sum;
    }

    /// Steps 3 and 4.
    void loop_until_still(PlaneGrid& grid, double d) {
        double before = sum_of_distances();
        for (int loop = 0; loop < options_.loops; ++loop) {
            for (int i = 0; i < count(); ++i) move(grid, i, d);
            ++result_.rounds;
            const double after = sum_of_distances();
            if (all_in_place() || !(after < (1.0 - kProgress) * before)) return;
            before = after;
        }
    }

    /// Moves feature i towards its place and drags its neighbours, as far as no triangle turns.
    void move(PlaneGrid& grid, int i, double d) {
        const Vector2d f = position(features_[static_cast<std::size_t>(i)]), way = place(i) - f;
        if (way.isZero(0.0)) return;
        Vector2d t = way * std::min(1.0 / d, kSlope / way.norm());
        moved_.clear();
        grid.near(f.x(), f.y(), d, [&](int h) {
            const double share = d - (position(h) - f).norm();
            if (share > 0.0) moved_.push_back({h, position(h), share});
        });
        collect_triangles();
        for (int halving = 0; halving < kHalvings; ++halving, t *= 0.5) {
            for (const Moved& m : moved_)
                result_.rays.row(m.vertex).head<2>() = (m.before + m.share * t).transpose();
            if (valid()) {
                for (const Moved& m : moved_) grid.refile(result_.rays, m.vertex);
                result_.shortened += halving > 0;
                return;
            }
        }
        for (const Moved& m : moved_) result_.rays.row(m.vertex).head<2>() = m.before.transpose();
        ++result_.shortened;
    }

    /// The triangles of the vertices that move.
    void collect_triangles() {
        ++stamp_;
        triangles_.clear();
        for (const Moved& m : moved_) {
            const int first = half_edges_.outgoing(m.vertex);
            int h = first;
            do {  // inner vertices: the half-edges close around them
                int& checked = checked_[static_cast<std::size_t>(HalfEdgeTable::face(h))];
                if (checked != stamp_) triangles_.push_back(HalfEdgeTable::face(h));
                checked = stamp_;
                h = half_edges_.turn(h);
            } while (h != first);
        }
    }

    bool valid() const {
        return std::all_of(triangles_.begin(), triangles_.end(), [&](int f) {
            const auto corner = [&](int k) -> Ray { return result_.rays.row(half_edges_.from(3 * f + k)); };
            return orientation(corner(0), corner(1), corner(2)) > 0;
        });
    }

    /// Features in place to the tolerance go to their places bit for bit, where no triangle turns.
    void set_exactly() {
        for (int i = 0; i < count(); ++i) {
            const int f = features_[static_cast<std::size_t>(i)];
            if (!in_place(i)) continue;
            moved_.assign(1, {f, position(f), 1.0});
            collect_triangles();
            result_.rays.row(f).head<2>() = place(i).transpose();
            if (!valid()) result_.rays.row(f).head<2>() = moved_.front().before.transpose();
        }
    }

    struct Moved {
        int vertex;
        Vector2d before;
        double share;  ///< d - |h - f|
    };

    const HalfEdgeTable half_edges_;
    const std::vector<int>& features_;
    const Points& places_;
    const WarpOptions& options_;
    std::vector<int> inner_;
    std::vector<Moved> moved_;
    std::vector<int> triangles_;  ///< with a vertex in moved_
    std::vector<int> checked_;    ///< per triangle: the stamp of its last move
    int stamp_ = 0;
    WarpedMap result_;
};

}  // namespace

WarpedMap warp_map(const Mesh& mesh, const std::vector<int>& loop, const Points& rays,
                   const std::vector<int>& features, const Points& places, const WarpOptions& options) {
    return Warper(mesh, loop, rays, features, places, options).run();
}

}  // namespace automorph
