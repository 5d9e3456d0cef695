#include "morph/registration/denoise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

constexpr double kCrumpled = 0.35;  // above every clean mesh tried, sharp-edged parts (0.29) included
constexpr double kSmoothEnough = 0.1;
constexpr int kMostRounds = 8;
constexpr int kFewestVertices = 100;  // below, sharp corners are the shape (a tetrahedron has 0.67)

Points neighbour_means(const Mesh& mesh) {
    Points sum = Points::Zero(mesh.vertex_count(), 3);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(mesh.vertex_count());
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int v = mesh.F(f, k);
            sum.row(v) += mesh.V.row(mesh.F(f, (k + 1) % 3)) + mesh.V.row(mesh.F(f, (k + 2) % 3));
            count[v] += 2.0;
        }
    }
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (count[v] > 0.0) {
            sum.row(v) /= count[v];
        } else {
            sum.row(v) = mesh.V.row(v);
        }
    }
    return sum;
}

}  // namespace

double crumpling(const Mesh& mesh) {
    Points area_vector = Points::Zero(mesh.vertex_count(), 3);
    Eigen::VectorXd area = Eigen::VectorXd::Zero(mesh.vertex_count());
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const Eigen::RowVector3d n = doubled_area_vector(mesh.V, mesh.F, f);
        const double length = n.norm();
        for (int k = 0; k < 3; ++k) {
            area_vector.row(mesh.F(f, k)) += n;
            area[mesh.F(f, k)] += length;
        }
    }
    std::vector<double> lost;
    lost.reserve(mesh.vertex_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (area[v] > 0.0) lost.push_back(1.0 - area_vector.row(v).norm() / area[v]);
    }
    if (lost.empty()) return 0.0;
    const auto median = lost.begin() + static_cast<std::ptrdiff_t>(lost.size() / 2);
    std::nth_element(lost.begin(), median, lost.end());
    return *median;
}

std::optional<Mesh> denoised(const Mesh& mesh) {
    if (mesh.vertex_count() < kFewestVertices || crumpling(mesh) < kCrumpled) return std::nullopt;
    Mesh smooth = mesh;
    for (int round = 0; round < kMostRounds; ++round) {
        smooth.V = neighbour_means(smooth);
        if (crumpling(smooth) < kSmoothEnough) break;
    }
    return smooth;
}

}  // namespace automorph
