#include "morph/registration/starts.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace automorph {

namespace {

// Uniform over SO(3), by rejection in the 4-ball: no trigonometry, so the same bits everywhere.
Eigen::Quaterniond random_rotation(std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    while (true) {
        Eigen::Vector4d q;
        for (int k = 0; k < 4; ++k) q[k] = static_cast<double>(generator() >> 11) * 0x1.0p-52 - 1.0;
        const double square = q.squaredNorm();
        if (square > 0.01 && square <= 1.0) return Eigen::Quaterniond(q / std::sqrt(square));
    }
}

// The 120 unit icosians, one of each pair +-q: the rotations of the icosahedron.
std::vector<Eigen::Quaterniond> icosahedral_rotations() {
    std::vector<Eigen::Vector4d> all;
    for (int k = 0; k < 4; ++k) all.push_back(Eigen::Vector4d::Unit(k));
    for (int signs = 0; signs < 8; ++signs) {
        all.emplace_back(0.5, signs & 1 ? -0.5 : 0.5, signs & 2 ? -0.5 : 0.5, signs & 4 ? -0.5 : 0.5);
    }
    // Even permutations of (phi, 1, 1 / phi, 0) / 2 with any signs; the first sign is fixed by +-q.
    const double phi = 0.5 * (1.0 + std::sqrt(5.0));
    constexpr int kEven[12][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 0, 3, 2}, {1, 2, 0, 3}, {1, 3, 2, 0},
                                  {2, 0, 1, 3}, {2, 1, 3, 0}, {2, 3, 0, 1}, {3, 0, 2, 1}, {3, 1, 0, 2}, {3, 2, 1, 0}};
    for (const auto& place : kEven) {
        for (int signs = 0; signs < 4; ++signs) {
            Eigen::Vector4d q = Eigen::Vector4d::Zero();
            q[place[0]] = 0.5 * phi;
            q[place[1]] = signs & 1 ? -0.5 : 0.5;
            q[place[2]] = (signs & 2 ? -0.5 : 0.5) / phi;
            all.push_back(q);
        }
    }
    std::vector<Eigen::Quaterniond> rotations;
    for (const Eigen::Vector4d& q : all) rotations.emplace_back(q[0], q[1], q[2], q[3]);
    return rotations;
}

// Columns: the principal axes as a right-handed frame, smallest spread first.
Eigen::Matrix3d principal_axes(const Points& points) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(points.transpose() * points);
    Eigen::Matrix3d axes = solver.eigenvectors();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
}

}  // namespace

std::vector<Eigen::Matrix3d> starting_rotations(const Points& source, const Points& target, std::uint64_t seed) {
    std::vector<Eigen::Matrix3d> rotations;
    const Eigen::Quaterniond turn = random_rotation(seed);
    for (const Eigen::Quaterniond& q : icosahedral_rotations()) rotations.push_back((q * turn).toRotationMatrix());

    const Eigen::Matrix3d source_axes = principal_axes(source), target_axes = principal_axes(target);
    for (int half_turn = 0; half_turn < 4; ++half_turn) {
        Eigen::Vector3d signs = Eigen::Vector3d::Constant(half_turn == 0 ? 1.0 : -1.0);
        if (half_turn > 0) signs[half_turn - 1] = 1.0;
        rotations.push_back(target_axes * signs.asDiagonal() * source_axes.transpose());
    }
    return rotations;
}

}  // namespace automorph
