#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "morph/shapes/jet.h"

/// The clay and the tools of a sculpture given by a field: bodies that are blended, cut and carved. Each is
/// written for a scalar S, double or Jet, and is at least C1. All lengths in the sculpture's unit.
namespace automorph::sculpt {

/// A point, or a vector, as formulas see it.
template <class S>
struct Vec {
    S x, y, z;
};
using Vec3 = Vec<double>;

template <class A, class B>
auto operator-(const Vec<A>& a, const Vec<B>& b) {
    return Vec<decltype(a.x - b.x)>{a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class A, class B>
auto dot(const Vec<A>& a, const Vec<B>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class S>
S square(const S& a) {
    return a * a;
}

/// sqrt(a^2 + softness^2): |a| without the kink.
template <class S>
S soft_abs(const S& a, double softness) {
    using std::sqrt;
    return sqrt(a * a + softness * softness);
}

/// Minimum that blends over where both are within k of each other; C2. k may vary in space.
template <class S, class K>
S blend(const S& a, const S& b, const K& k) {
    const bool is_a = value_of(a) < value_of(b);
    const S gap = is_a ? b - a : a - b;
    const S& least = is_a ? a : b;
    if (value_of(gap) >= value_of(k)) return least;
    const S h = 1.0 - gap / k;
    return least - h * h * h * k * (1.0 / 6.0);
}

/// `body` without `tool`, the edge rounded over k.
template <class S>
S carve(const S& body, const S& tool, double k) {
    return -blend(S(-body), tool, k);
}

/// From 0 at a to 1 at b, C1.
template <class S>
S ramp(const S& t, double a, double b) {
    const S s = (t - a) / (b - a);
    if (value_of(s) <= 0.0) return S(0.0);
    if (value_of(s) >= 1.0) return S(1.0);
    return s * s * (3.0 - 2.0 * s);
}

/// 1 at 0, 0 from |t| = 1 on, C2.
template <class S>
S bump_square(const S& t_square) {
    const S s = 1.0 - t_square;
    return value_of(s) <= 0.0 ? S(0.0) : S(s * s * s);
}
template <class S>
S bump(const S& t) {
    return bump_square(S(t * t));
}

/// Ellipsoid with semi-axes along x, y, z, distance to first order.
template <class S>
S ellipsoid(const Vec<S>& p, const Vec3& centre, const Vec3& semi) {
    using std::sqrt;
    const Vec<S> q{(p.x - centre.x) * (1.0 / semi.x), (p.y - centre.y) * (1.0 / semi.y),
                   (p.z - centre.z) * (1.0 / semi.z)};
    const Vec<S> w{q.x * (1.0 / semi.x), q.y * (1.0 / semi.y), q.z * (1.0 / semi.z)};
    const S a = dot(q, q), b = dot(w, w) + 1e-12;  // finite at the centre
    const S norm = sqrt(a + 1e-12);
    return norm * (norm - 1.0) / sqrt(b);
}

/// A right-handed turn of coordinates by angles (degrees) about x, then y, then z.
struct Turn {
    double m[3][3];
};
inline Turn turn(double about_x, double about_y, double about_z) {
    const double degree = 0.017453292519943295;
    const double cx = std::cos(about_x * degree), sx = std::sin(about_x * degree),
                 cy = std::cos(about_y * degree), sy = std::sin(about_y * degree),
                 cz = std::cos(about_z * degree), sz = std::sin(about_z * degree);
    // R = Rz Ry Rx; points go to local coordinates by its transpose.
    return {{{cz * cy, cz * sy * sx - sz * cx, cz * sy * cx + sz * sx},
             {sz * cy, sz * sy * sx + cz * cx, sz * sy * cx - cz * sx},
             {-sy, cy * sx, cy * cx}}};
}
/// Coordinates of p in the frame at `centre`.
template <class S>
Vec<S> local(const Vec<S>& p, const Vec3& centre, const Turn& t) {
    const Vec<S> d{p.x - centre.x, p.y - centre.y, p.z - centre.z};
    return {d.x * t.m[0][0] + d.y * t.m[1][0] + d.z * t.m[2][0],
            d.x * t.m[0][1] + d.y * t.m[1][1] + d.z * t.m[2][1],
            d.x * t.m[0][2] + d.y * t.m[1][2] + d.z * t.m[2][2]};
}
template <class S>
S ellipsoid(const Vec<S>& p, const Vec3& centre, const Vec3& semi, const Turn& t) {
    return ellipsoid(local(p, centre, t), Vec3{0, 0, 0}, semi);
}

/// Round limb from a (radius ra) to b (radius rb).
template <class S>
S limb(const Vec<S>& p, const Vec3& a, const Vec3& b, double ra, double rb) {
    using std::sqrt;
    const Vec3 axis = b - a;
    const Vec<S> from = p - a;
    S t = dot(from, axis) * (1.0 / dot(axis, axis));
    if (value_of(t) < 0.0) t = S(0.0);
    if (value_of(t) > 1.0) t = S(1.0);
    const Vec<S> off{from.x - t * axis.x, from.y - t * axis.y, from.z - t * axis.z};
    return sqrt(dot(off, off) + 1e-12) - (ra + (rb - ra) * (t * t * (3.0 - 2.0 * t)));
}

/// A point of a strand with its thickness.
struct Bead {
    Vec3 at;
    double radius;
};

/// A round strand along a cubic B-spline: rims and folds. It starts at the first bead and ends at the last;
/// in between it rounds them off. No bend may be narrower than the strand is thick. Made once per strand.
class Strand {
public:
    /// A place on the curve with its derivatives by the parameter u, which is k at bead k.
    struct Place {
        Vec3 point, tangent, bend;
        double radius, widening;
    };

    explicit Strand(std::vector<Bead> beads);

    /// Of the point of the curve that is nearest to p.
    double nearest(const Vec3& p) const;
    Place at(double u) const;
    double end() const { return static_cast<double>(beads_.size()) - 3.0; }
    /// p is so far away that no blend reaches it.
    bool is_out_of_reach(const Vec3& p) const;

    /// How fast the foot of the perpendicular from p moves past a place: its squared speed, more or less by
    /// the bend. Not below a share of the speed: near the centre of a bend, feet are anywhere.
    static double foot_slope(const Place& place, const Vec3& p) {
        const double speed = dot(place.tangent, place.tangent);
        return std::max(speed - dot(p - place.point, place.bend), 0.3 * speed);
    }

    /// Beyond it no blend near the surface comes to a strand, with all that it is blended with in turn.
    static constexpr double kReach = 6.5;

private:
    std::vector<Bead> beads_;  // and one more beyond each end
    std::vector<Vec3> samples_;
    Vec3 centre_;
    double radius_ = 0.0;  // of a ball about all of it
};

/// Distance from a strand; kReach where it is out of reach.
template <class S>
S strand(const Vec<S>& p, const Strand& line) {
    using std::sqrt;
    const Vec3 at{value_of(p.x), value_of(p.y), value_of(p.z)};
    if (line.is_out_of_reach(at)) return S(Strand::kReach);
    const double u = line.nearest(at);
    const Strand::Place place = line.at(u);
    // The distance does not change with u; the radius does, and u with p by the derivative of the foot.
    const Vec<S> off = p - place.point;
    S radius(place.radius);
    if (u > 0.0 && u < line.end()) {
        const S along = dot(off, place.tangent) * (1.0 / Strand::foot_slope(place, at));
        radius = radius + (along - value_of(along)) * place.widening;
    }
    return sqrt(dot(off, off) + 1e-12) - radius;
}

/// The surface moved outwards by `amount` at `centre`, less away from it, not at all beyond the semi-axes;
/// inwards if negative. C2.
template <class S>
S swell(const S& d, const Vec<S>& p, const Vec3& centre, const Vec3& semi, double amount) {
    return d - amount * bump_square(S(square(S((p.x - centre.x) * (1.0 / semi.x))) +
                                      square(S((p.y - centre.y) * (1.0 / semi.y))) +
                                      square(S((p.z - centre.z) * (1.0 / semi.z)))));
}

/// Whether p is within `radius` of `centre`.
template <class S>
bool near(const Vec<S>& p, const Vec3& centre, double radius) {
    const double x = value_of(p.x) - centre.x, y = value_of(p.y) - centre.y, z = value_of(p.z) - centre.z;
    return x * x + y * y + z * z < radius * radius;
}

}  // namespace automorph::sculpt
