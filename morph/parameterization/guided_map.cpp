#include "morph/parameterization/guided_map.h"

#include <Eigen/SparseLU>
#include <algorithm>
#include <utility>

#include "morph/exact/predicates.h"
#include "morph/parameterization/map_weights.h"

namespace automorph {

namespace {

constexpr int kRoundsPerRing = 8;  // rounds after which the region grows by a ring more each time

std::vector<int> flipped(const Triangles& F, const Points& rays) {
    std::vector<int> found;
    for (int f = 0; f < F.rows(); ++f) {
        if (orientation(rays.row(F(f, 0)), rays.row(F(f, 1)), rays.row(F(f, 2))) <= 0) found.push_back(f);
    }
    return found;
}

/// The free vertices of a repair.
class Region {
public:
    Region(const Mesh& mesh, const std::vector<char>& fixed)
        : mesh_(mesh), fixed_(fixed), in_(fixed.size(), 0) {}

    /// Adds the corners of triangles. Returns whether the region grew.
    bool add(const std::vector<int>& triangles) {
        bool grew = false;
        for (const int f : triangles) {
            for (int k = 0; k < 3; ++k) grew = add_vertex(mesh_.F(f, k)) || grew;
        }
        return grew;
    }

    /// Adds the corners of triangles and some rings around them. Returns whether the region grew.
    bool add_rings(const std::vector<int>& triangles, int rings) {
        std::vector<char> near(in_.size(), 0);
        for (const int f : triangles) {
            for (int k = 0; k < 3; ++k) near[static_cast<std::size_t>(mesh_.F(f, k))] = 1;
        }
        bool grew = add(triangles);
        for (int ring = 0; ring < rings; ++ring) {
            std::vector<int> touching;
            for (int f = 0; f < mesh_.triangle_count(); ++f) {
                if (near[static_cast<std::size_t>(mesh_.F(f, 0))] ||
                    near[static_cast<std::size_t>(mesh_.F(f, 1))] ||
                    near[static_cast<std::size_t>(mesh_.F(f, 2))])
                    touching.push_back(f);
            }
            for (const int f : touching) {
                for (int k = 0; k < 3; ++k) near[static_cast<std::size_t>(mesh_.F(f, k))] = 1;
            }
            grew = add(touching) || grew;
        }
        return grew;
    }

    /// Per vertex its row among the unknowns, -1 outside.
    std::vector<int> rows() const {
        std::vector<int> row(in_.size(), -1);
        int next = 0;
        for (std::size_t v = 0; v < in_.size(); ++v) {
            if (in_[v]) row[v] = next++;
        }
        return row;
    }

    int size() const { return size_; }

private:
    bool add_vertex(int v) {
        const auto at = static_cast<std::size_t>(v);
        if (in_[at] || fixed_[at]) return false;
        in_[at] = 1;
        ++size_;
        return true;
    }

    const Mesh& mesh_;
    const std::vector<char>& fixed_;
    std::vector<char> in_;
    int size_ = 0;
};

/// Rays with those of the region at the weighted means of their neighbours.
Points relaxed(const Mesh& mesh, const Region& region, const Points& places, MapDomain domain) {
    const std::vector<int> row = region.rows();
    const WeightMatrix weights = weight_matrix(mesh, row, region.size(), MapWeights::MeanValue);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixX3d rhs = Eigen::MatrixX3d::Zero(region.size(), 3);
    for (int r = 0; r < region.size(); ++r) {
        double sum = 0.0;
        for (decltype(weights.w)::InnerIterator it(weights.w, r); it; ++it) {
            sum += it.value();
            const int column = row[static_cast<std::size_t>(it.col())];
            if (column >= 0) {
                entries.emplace_back(r, column, -it.value());
            } else {
                rhs.row(r) += it.value() * places.row(it.col());
            }
        }
        entries.emplace_back(r, r, sum);
    }
    Eigen::SparseMatrix<double> A(region.size(), region.size());
    A.setFromTriplets(entries.begin(), entries.end());
    // Rows are diagonally dominant: elimination is stable without pivoting.
    Eigen::SparseLU<Eigen::SparseMatrix<double>, Eigen::COLAMDOrdering<int>> solver;
    solver.setPivotThreshold(0.0);
    solver.compute(A);
    if (solver.info() != Eigen::Success) return places;
    const Eigen::MatrixX3d solution = solver.solve(rhs);
    if (!solution.allFinite()) return places;

    Points rays = places;
    for (std::size_t v = 0; v < row.size(); ++v) {
        if (row[v] < 0) continue;
        Eigen::RowVector3d ray = solution.row(row[v]);
        if (domain == MapDomain::Disk) ray[2] = 1.0;
        if (domain == MapDomain::Sphere) ray.stableNormalize();
        rays.row(static_cast<Eigen::Index>(v)) = ray;
    }
    return rays;
}

}  // namespace

GuidedMap guided_map(const Mesh& mesh, const std::vector<char>& fixed, const Points& places,
                     MapDomain domain) {
    GuidedMap map{places};
    std::vector<int> bad = flipped(mesh.F, places);
    map.flipped_before = static_cast<int>(bad.size());
    Region region(mesh, fixed);
    region.add(bad);
    while (!bad.empty()) {
        map.rays = relaxed(mesh, region, places, domain);
        ++map.rounds;
        bad = flipped(mesh.F, map.rays);
        bool grew = false;
        for (int rings = 1 + map.rounds / kRoundsPerRing;
             !bad.empty() && !grew && rings <= 2 * mesh.vertex_count(); rings *= 2)
            grew = region.add_rings(bad, rings);
        if (!grew) break;  // nothing left to free
    }
    map.flipped = static_cast<int>(bad.size());
    map.moved = region.size();
    return map;
}

}  // namespace automorph
