#include "morph/registration/surface_sample.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

// 53 random bits in [0, 1): the standard fixes the engine's numbers, but not those of its distributions.
double uniform(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1.0p-53; }

// Interleaves the top 20 bits of the three coordinates, each scaled to [0, 1).
std::uint64_t morton_code(const Eigen::Vector3d& unit) {
    constexpr int kBits = 20;
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto cell = static_cast<std::uint64_t>(std::clamp(unit[axis], 0.0, 1.0) * ((1 << kBits) - 1));
        for (int bit = 0; bit < kBits; ++bit) code |= ((cell >> bit) & 1u) << (3 * bit + axis);
    }
    return code;
}

SurfaceSample rows_of(const SurfaceSample& sample, const std::vector<int>& rows) {
    return {sample.points(rows, Eigen::all), sample.normals(rows, Eigen::all)};
}

SurfaceSample sort_along_morton_curve(const SurfaceSample& sample) {
    const Eigen::RowVector3d low = sample.points.colwise().minCoeff();
    const double extent = (sample.points.colwise().maxCoeff() - low).maxCoeff();
    std::vector<std::uint64_t> code(sample.size());
    for (int i = 0; i < sample.size(); ++i) {
        code[i] = morton_code((sample.points.row(i) - low).transpose() / (extent > 0.0 ? extent : 1.0));
    }
    std::vector<int> order(sample.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return code[i] < code[j]; });
    return rows_of(sample, order);
}

// Mixes an edge's two ends into 64 bits (the finaliser of SplitMix64).
std::uint64_t hash_edge(int from, int to) {
    std::uint64_t h = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32) +
                      static_cast<std::uint32_t>(to) + 0x9e3779b97f4a7c15u;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    return h ^ (h >> 31);
}

}  // namespace

SurfaceSize surface_size(const Mesh& mesh) {
    if (mesh.triangle_count() == 0) throw InvalidMesh("registration: the mesh has no triangles");
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.V.row(v).allFinite()) {
            throw InvalidMesh(fmt::format("registration: vertex {} has a coordinate that is not finite", v));
        }
    }
    SurfaceSize size;
    size.centre = centre_of_mass(mesh);
    // The integral of |x|^2 over a triangle with corners a, b, c is area / 6 (|a|^2 + |b|^2 + |c|^2 + ab + bc + ca)
    // = area / 12 (|a|^2 + |b|^2 + |c|^2 + |a + b + c|^2).
    const Eigen::VectorXd areas = triangle_areas(mesh);
    double second_moment = 0.0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double squares = 0.0;
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector3d p = mesh.V.row(mesh.F(f, k)).transpose() - size.centre;
            sum += p;
            squares += p.squaredNorm();
        }
        second_moment += areas[f] / 12.0 * (squares + sum.squaredNorm());
    }
    const double total = areas.sum();
    size.radius = total > 0.0 ? std::sqrt(second_moment / total) : 0.0;
    if (!(size.radius > 0.0) || !std::isfinite(size.radius)) {
        throw InvalidMesh(fmt::format("registration: the surface's area is {:g} and its radius {:g}; both must be "
                                      "positive and finite",
                                      total, size.radius));
    }
    return size;
}

SurfaceSample sample_surface(const Mesh& mesh, const SurfaceSize& size, int count, std::uint64_t seed) {
    const Eigen::VectorXd areas = triangle_areas(mesh);
    const Points vertex_normal = vertex_normals(mesh);
    const double total = areas.sum();
    std::mt19937_64 generator(seed);
    SurfaceSample sample{Points(count, 3), Points(count, 3)};
    int f = 0;
    double area_before = 0.0;  // of the triangles before f
    for (int i = 0; i < count; ++i) {
        const double place = (i + uniform(generator)) / count * total;
        while (f + 1 < mesh.triangle_count() && area_before + areas[f] <= place) area_before += areas[f++];
        const double u = std::sqrt(uniform(generator)), v = uniform(generator);
        const Eigen::RowVector3d barycentric(1.0 - u, u * (1.0 - v), u * v);
        const Eigen::RowVector3i corners = mesh.F.row(f);
        Eigen::RowVector3d point = Eigen::RowVector3d::Zero(), normal = Eigen::RowVector3d::Zero();
        for (int k = 0; k < 3; ++k) {
            point += barycentric[k] * mesh.V.row(corners[k]);
            normal += barycentric[k] * vertex_normal.row(corners[k]);
        }
        sample.points.row(i) = (point - size.centre.transpose()) / size.radius;
        sample.normals.row(i) = normal.squaredNorm() > 0.0 ? normal.normalized() : normal;
    }
    return sort_along_morton_curve(sample);
}

SurfaceSample thin_out(const SurfaceSample& sample, int count) {
    const int n = sample.size();
    if (count >= n) return sample;
    std::vector<int> rows(count);
    for (int i = 0; i < count; ++i) rows[i] = static_cast<int>((2LL * i + 1) * n / (2LL * count));
    return rows_of(sample, rows);
}

bool is_closed(const Mesh& mesh) {
    // Half-edges of inner edges cancel in this sum of hashes; a remainder is a border (of which the sum is zero
    // by accident with probability 2^-64). One pass and no memory, where counting edges would sort.
    std::uint64_t sum = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int from = mesh.F(f, k), to = mesh.F(f, (k + 1) % 3);
            sum += hash_edge(from, to) - hash_edge(to, from);
        }
    }
    return sum == 0;
}

}  // namespace automorph
