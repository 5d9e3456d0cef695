#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "morph/exact/predicates.h"

namespace automorph {

/// A triangle of the surface as its map's energy sees it, from its squared edge lengths L_i^2 (L_i opposite
/// corner i) and its area A, both regularised: L_i^2 + eps, so that triangles without area do no harm.
struct TriangleMetric {
    double cotangent[3];  ///< L_j^2 + L_k^2 - L_i^2: 4 A times the cotangent at corner i
    double half_area;     ///< A / 2
    double inverse;       ///< 1 / (8 A)
};

/// @param eps  added to the squared edge lengths, > 0, in squared units of the corners
TriangleMetric triangle_metric(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
                               const Eigen::Vector3d& p2, double eps);

/// A spherical triangle of unit rays counts as valid while d > kSlimmest |b - a| |c - a| + kRounding (|b - a|
/// + |c - a|). The second term exceeds what rounding rays to doubles changes, also after a rotation, so that
/// the exact sign is positive too.
constexpr double kSlimmest = 1e-12, kRounding = 1e-14;
bool clearly_positive(const Ray& a, const Ray& b, const Ray& c);

/// A vertex of a map onto the unit sphere and the triangles about it: where may it go, and at what energy?
///
/// Energy  symmetric Dirichlet, per triangle E = (A Q / 8) (4 / d^2 + 1 / A^2), Q = sum_i cotangent_i l_i^2,
/// l the
///         chords of the spherical triangle, d = det[a b c]: the symmetric stretch of [Schreiner04] with its
///         barrier at the limit of validity, d = 0. 4 A for an isometry.
/// Frame   x and the neighbours in tangent coordinates of the vertex's present place x0, as differences from
/// it: no
///         digits are lost in small stars.
class SphereStar {
public:
    struct Neighbour {
        double x, y, z;  ///< ray minus x0: two tangent coordinates, and the one along x0
    };
    struct Side {              ///< the triangle x, w_k, w_k+1
        double constant;       ///< share of the fixed chord in Q
        double at_k, at_next;  ///< weights of |x - w_k+1|^2 and |x - w_k|^2: the cotangents at w_k and w_k+1
        double half_area, inverse;
    };

    /// Starts over at x0, a unit vector.
    void reset(const Ray& x0);
    /// Adds neighbours counter-clockwise, each with the metric of the triangle between it and the next one.
    /// @param own  which corner of the metric is the vertex itself
    void add(const Ray& ray, const TriangleMetric& metric, int own);
    /// Call after the last neighbour.
    void close();

    /// Energy with the vertex at the tangent offset (s, t) from x0, put back on the sphere; infinite where a
    /// triangle comes too close to d = 0 (kSlimmest, kRounding).
    double energy(double s, double t) const;
    /// The unit ray at that offset.
    Ray ray(double s, double t) const;
    /// Tangent coordinates (s, t) that lead to a ray on this side of the sphere.
    Eigen::Vector2d offset(const Ray& ray) const;

    /// A Newton step with |eigenvalues|, no longer than kLongestStep of the mean distance to the neighbours.
    struct Step {
        double s, t;
        double energy;     ///< at x0
        double predicted;  ///< decrease of the quadratic model
    };
    Step newton() const;

    double radius() const { return radius_; }  ///< mean distance to the neighbours
    std::size_t size() const { return neighbours_.size(); }
    const Neighbour& neighbour(std::size_t k) const { return neighbours_[k]; }

private:
    std::vector<Neighbour> neighbours_;
    std::vector<Side> sides_;
    Ray x0_, e1_, e2_;
    double radius_ = 0.0;
};

/// Longest step, as a share of the mean distance to the neighbours.
constexpr double kLongestStep = 0.7;

}  // namespace automorph
