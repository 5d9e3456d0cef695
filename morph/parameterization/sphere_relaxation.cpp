#include "morph/parameterization/sphere_relaxation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "morph/mesh/index.h"

namespace automorph {

namespace {

/// Regularisation of squared edge lengths, as a share of the mean triangle area.
constexpr double kRegularisation = 1e-3;
/// A vertex sleeps when its step promises less than this share of its star's energy.
constexpr double kIdle = 1e-4;
constexpr int kHalvings = 12;
/// Shrinking factor of the distances at which a vertex is put back, and how far to go: 0.6^60 = 5e-14.
constexpr double kShrink = 0.6;
constexpr int kShrinkings = 60;

}  // namespace

SphereRelaxation::SphereRelaxation(HalfEdges half_edges, const Points& V, std::vector<char> fixed,
                                   double domain)
    : mesh(std::move(half_edges)),
      rays(Points::Zero(V.rows(), 3)),
      V_(V),
      fixed_(std::move(fixed)),
      domain_(domain) {
    awake_.assign(at(static_cast<int>(V.rows())), 1);
    metric_.resize(mesh.origin.size() / 4);
}

void SphereRelaxation::measure(const std::vector<int>& triangles) {
    double area = 0.0;
    for (const int f : triangles) {
        const Eigen::Vector3d p = V_.row(mesh.origin[at(4 * f)]);
        area += 0.5 * (V_.row(mesh.origin[at(4 * f + 1)]).transpose() - p)
                          .cross(V_.row(mesh.origin[at(4 * f + 2)]).transpose() - p)
                          .norm();
    }
    // A base without any area (all its vertices in one plane or place) is regular: only eps counts.
    scale_ = area > 0.0 ? std::sqrt(domain_ / area) : 0.0;
    eps_ = kRegularisation * domain_ / static_cast<double>(triangles.size());
    for (const int f : triangles) measure_triangle(f);
}

void SphereRelaxation::measure_triangle(int f) {
    metric_[at(f)] = triangle_metric(scale_ * V_.row(mesh.origin[at(4 * f)]).transpose(),
                                     scale_ * V_.row(mesh.origin[at(4 * f + 1)]).transpose(),
                                     scale_ * V_.row(mesh.origin[at(4 * f + 2)]).transpose(), eps_);
}

void SphereRelaxation::gather(int vertex) {
    star_.reset(rays.row(vertex));
    const int first = mesh.out[at(vertex)];
    int h = first;
    do {
        star_.add(rays.row(mesh.target(h)), metric_[at(HalfEdges::triangle(h))], h & 3);
        h = mesh.turn(h);
    } while (h != first);
    star_.close();
}

bool SphereRelaxation::insert(int vertex) {
    // out[vertex] leads to the vertex u it had been collapsed onto: from there it sees all of its ring.
    const int u = mesh.target(mesh.out[at(vertex)]);
    rays.row(vertex) = rays.row(u);
    gather(vertex);
    const std::size_t n = star_.size();

    // Into the sector at u, halfway between its sides u -> r (neighbour 1) and u -> l (the last). Their
    // directions sum to the bisector (to its opposite where the sector is wider than pi), and so do their
    // inward normals: the former vanish at an angle of pi, the latter at 0 and 2 pi.
    const auto &r = star_.neighbour(1), &l = star_.neighbour(n - 1);
    const Eigen::Vector2d to_r = Eigen::Vector2d(r.x, r.y).normalized(),
                          to_l = Eigen::Vector2d(l.x, l.y).normalized();
    const bool wide = to_r.x() * to_l.y() < to_r.y() * to_l.x();
    const Eigen::Vector2d between = wide ? Eigen::Vector2d(-to_r - to_l) : Eigen::Vector2d(to_r + to_l);
    const Eigen::Vector2d normals(to_l.y() - to_r.y(), to_r.x() - to_l.x());
    const Eigen::Vector2d inwards = (between + normals).normalized();

    Eigen::Vector2d mean(0.0, 0.0);
    double reach = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        mean += Eigen::Vector2d(star_.neighbour(k).x, star_.neighbour(k).y) / static_cast<double>(n);
        const double x = star_.neighbour(k).x, y = star_.neighbour(k).y;
        reach = std::max(reach, std::sqrt(x * x + y * y));
    }

    Eigen::Vector2d best(0.0, 0.0);
    double lowest = star_.energy(mean.x(), mean.y());
    if (std::isfinite(lowest)) best = mean;
    double before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < kShrinkings; ++k, reach *= kShrink) {
        const double energy = star_.energy(reach * inwards.x(), reach * inwards.y());
        if (energy < lowest) {
            lowest = energy;
            best = reach * inwards;
        }
        if (std::isfinite(before) && energy > before) break;  // below, the barrier of the sides at u
        before = energy;
    }
    if (!std::isfinite(lowest)) return false;
    rays.row(vertex) = star_.ray(best.x(), best.y());
    return true;
}

double SphereRelaxation::relax(int vertex) {
    awake_[at(vertex)] = 0;
    if (is_fixed(vertex)) return 0.0;
    gather(vertex);
    const SphereStar::Step step = star_.newton();
    if (!(step.predicted > kIdle * step.energy)) return 0.0;
    double share = 1.0;
    for (int k = 0; k < kHalvings; ++k, share *= 0.5) {
        const double energy = star_.energy(share * step.s, share * step.t);
        if (!(energy < step.energy)) continue;
        rays.row(vertex) = star_.ray(share * step.s, share * step.t);
        wake_star(vertex);
        return step.energy - energy;
    }
    return 0.0;
}

double SphereRelaxation::sweep(const std::vector<int>& vertices) {
    double decrease = 0.0;
    for (const int v : vertices) {
        if (awake_[at(v)]) decrease += relax(v);
    }
    // An isometry has an energy of 4 A per triangle.
    return decrease / (4.0 * domain_);
}

void SphereRelaxation::sweep(const std::vector<int>& vertices, int most) {
    for (int k = 0; k < most; ++k) {
        if (sweep(vertices) < kSettled) break;
    }
}

void SphereRelaxation::wake() {
    std::fill(awake_.begin(), awake_.end(), 1);
}

void SphereRelaxation::wake_star(int vertex) {
    awake_[at(vertex)] = 1;
    const int first = mesh.out[at(vertex)];
    int h = first;
    do {
        awake_[at(mesh.target(h))] = 1;
        h = mesh.turn(h);
    } while (h != first);
}

}  // namespace automorph
