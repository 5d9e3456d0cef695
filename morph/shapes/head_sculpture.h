#pragma once

#include "morph/shapes/sculpt.h"

/// The neutral head, sculpted in centimetres as head_surface() describes: p is a point, q the same with x
/// folded to the left half, on which everything paired is made once. Distances after the means of Farkas,
/// Anthropometry of the Head and Face (1994), between those of women and men. Each with_*() adds its part to
/// the field d, and leaves alone what is out of its reach.
namespace automorph::sculpt {

inline constexpr double kHeadHeight = 23.0;  // chin to crown, cm

// ---- masses: cranium, face, jaw, neck --------------------------------------------------------------
template <class S>
S skull(const Vec<S>& p, const Vec<S>& q) {
    S d = ellipsoid(p, {0, 3.7, -2.2}, {7.5, 7.5, 7.4});
    d = blend(d, ellipsoid(p, {0, 3.4, 1.7}, {6.2, 7.3, 7.4}), 4.0);
    // temples
    return carve(d, ellipsoid(q, {9.0, 0.8, 5.2}, {2.0, 3.4, 3.6}), 2.2);
}

template <class S>
S face(const Vec<S>& p, const Vec<S>& q) {
    static const Turn masseter = turn(-16, 0, -7), malar = turn(0, 35, -14);
    // maxilla and the barrel of the teeth
    S d = ellipsoid(p, {0, -3.0, 2.4}, {5.5, 6.8, 6.2});
    d = blend(d, ellipsoid(p, {0, -6.3, 4.7}, {3.7, 4.4, 5.0}), 2.2);
    // mandible
    d = blend(d, limb(q, {4.3, -7.3, 0.5}, {1.2, -10.0, 7.0}, 0.9, 1.3), 1.8);
    d = blend(d, ellipsoid(q, {4.5, -4.8, 2.0}, {1.35, 3.8, 2.6}, masseter), 2.2);
    // cheekbone and arch
    d = blend(d, ellipsoid(q, {3.7, -2.4, 5.2}, {2.3, 1.7, 2.0}, malar), 2.6);
    d = blend(d, limb(q, {5.1, -1.8, 4.4}, {6.0, -1.2, 0.0}, 0.65, 0.45), 2.4);
    // cheeks, and the rim of the orbit at its outer side
    d = blend(d, ellipsoid(q, {3.1, -5.0, 5.0}, {2.2, 3.0, 2.6}), 2.0);
    d = blend(d, limb(q, {4.75, 1.3, 5.4}, {4.7, -1.6, 5.9}, 0.6, 0.8), 1.8);
    // cheek up to the lower lid
    d = blend(d, ellipsoid(q, {3.2, -1.75, 6.35}, {1.8, 1.0, 1.3}), 1.3);
    // muzzle: what the lips lie on
    d = blend(d, ellipsoid(p, {0, -6.7, 7.9}, {2.5, 2.0, 2.0}), 1.6);
    // chin
    return blend(d, ellipsoid(q, {0.45, -10.15, 8.2}, {1.4, 1.25, 1.5}), 1.6);
}

template <class S>
S neck(const Vec<S>& p, const Vec<S>& q) {
    S d = limb(Vec<S>{p.x * 1.04, p.y, p.z}, {0, -4.0, -1.9}, {0, -19.0, -3.4}, 4.5, 5.3);
    d = blend(d, limb(q, {5.0, -2.0, -2.2}, {1.0, -19.0, 2.6}, 0.8, 0.9), 1.8);
    d = blend(d, ellipsoid(p, {0, -14.2, 1.4}, {1.2, 2.0, 1.2}), 1.5);
    // trapezius
    d = blend(d, limb(q, {2.2, 1.0, -4.0}, {4.4, -20.0, -4.4}, 1.2, 1.6), 3.0);
    // The foot on which the bust stands.
    return blend(d, ellipsoid(p, {0, -20.0, -1.9}, {8.6, 5.2, 7.6}), 2.5);
}

// ---- eyes ------------------------------------------------------------------------------------------
inline constexpr Vec3 kEye{3.12, 0.0, 6.85};
inline constexpr Vec3 kEyeball{1.54, 1.34, 1.34}, kLids{1.76, 1.55, 1.58};  // semi-axes

template <class S>
S with_sockets(S d, const Vec<S>& p, const Vec<S>& q) {
    // brow ridge
    d = blend(d, limb(q, {0.9, 1.6, 8.2}, {4.3, 1.9, 6.2}, 0.75, 0.55), 1.8);
    d = blend(d, ellipsoid(p, {0, 1.9, 8.2}, {1.6, 0.9, 1.0}), 1.6);
    if (!near(q, {3.2, 0, 8.0}, 5.0)) return d;
    static const Turn socket = turn(0, 16, -8);
    return carve(d, ellipsoid(q, {2.75, 0.35, 8.95}, {1.9, 1.0, 1.55}, socket), 1.5);
}

template <class S>
S with_eyes(S d, const Vec<S>& q) {
    if (!near(q, kEye, 3.4)) return d;
    const S x = q.x - kEye.x, y = q.y - kEye.y;
    // Lids: a shell about the eyeball, softly joined below and to the sides, with a crease above it.
    const S k = 0.35 + 0.8 * ramp(S(0.35 * soft_abs(x, 0.2) - y), -0.6, 0.8);
    d = blend(d, ellipsoid(q, kEye, kLids), k);
    // The fold of skin between brow and lid.
    static const Turn hang = turn(0, 31, -9);
    d = blend(d, ellipsoid(q, {3.3, 1.22, 6.85}, {1.95, 0.5, 1.05}, hang), 0.45);
    // Opening between the margins of the lids.
    const S s = (x + 0.05) * (1.0 / 1.42), arch = 1.0 - s * s, line = 0.10 * s - 0.02;
    const S upper = line + 0.62 * arch * (1.0 - 0.22 * s), lower = line - 0.46 * arch * (1.0 + 0.22 * s);
    const S opening = -blend(S(upper - y), S(y - lower), 0.08) * 0.85;
    const S front = kEye.z - q.z + 0.2;  // the back half stays
    d = carve(d, S(-blend(S(-opening), S(-front), 0.2)), 0.09);
    d = blend(d, ellipsoid(q, kEye, kEyeball), 0.14);
    // caruncle
    return blend(d, ellipsoid(q, {1.85, -0.08, 7.55}, {0.25, 0.14, 0.25}), 0.15);
}

// ---- nose ------------------------------------------------------------------------------------------
template <class S>
S with_nose(S d, const Vec<S>& p, const Vec<S>& q) {
    if (!near(q, {0, -2.2, 9.5}, 6.0)) return d;
    static const Turn wing = turn(-12, 22, 8), hole = turn(-20, 12, 0);
    S n = limb(p, {0, 1.0, 8.35}, {0, -3.1, 10.4}, 0.58, 0.66);
    n = blend(n, ellipsoid(p, {0, -3.75, 10.65}, {0.86, 0.78, 0.98}), 0.8);
    n = blend(n, ellipsoid(q, {0.45, -2.7, 8.85}, {1.1, 2.5, 1.2}), 1.3);
    n = blend(n, ellipsoid(q, {1.02, -4.15, 9.6}, {0.55, 0.64, 0.95}, wing), 0.85);
    n = blend(n, limb(p, {0, -4.2, 10.8}, {0, -4.7, 9.8}, 0.42, 0.42), 0.5);
    d = blend(d, n, 0.9);
    return carve(d, ellipsoid(q, {0.55, -4.9, 10.2}, {0.28, 0.55, 0.55}, hole), 0.3);
}

// ---- mouth -----------------------------------------------------------------------------------------
template <class S>
S with_mouth(S d, const Vec<S>& p, const Vec<S>& q) {
    if (!near(p, {0, -7.0, 9.5}, 4.6)) return d;
    static const Turn above = turn(-12, 32, -10), below = turn(10, 29, 8);
    // philtrum
    d = carve(d, limb(p, {0, -5.0, 10.3}, {0, -6.35, 10.42}, 0.24, 0.36), 0.4);
    // Two halves and the tubercle make the upper lip, two halves the lower.
    S upper = ellipsoid(q, {1.0, -6.60, 9.45}, {1.62, 0.41, 0.66}, above);
    upper = blend(upper, ellipsoid(p, {0, -6.70, 9.7}, {0.65, 0.36, 0.5}), 0.5);
    S lower = ellipsoid(q, {0.65, -7.53, 9.42}, {1.6, 0.52, 0.72}, below);
    const S lips = blend(upper, lower, 0.05);
    d = blend(d, lips, 0.36);
    // corners
    return carve(d, ellipsoid(q, {2.5, -7.05, 8.95}, {0.16, 0.1, 0.22}), 0.45);
}

// ---- ears ------------------------------------------------------------------------------------------
template <class S>
S with_ears(S d, const Vec<S>& q) {
    if (!near(q, {7.2, -1.5, -1.5}, 5.6)) return d;
    using std::sqrt;
    static const Turn pose = turn(-10, -24, 6);
    // local: x outwards, y up, z forwards
    const Vec<S> e = local(q, {6.9, -1.4, -1.4}, pose);
    const S w = e.x, v = e.y, u = -e.z;  // out, up, back
    // Egg outline, wider above; the plate leans out towards its rim.
    const S width = 1.6 + 0.15 * v;
    const S qa = (u - 0.05) / width, qb = v * (1.0 / 2.95);
    const S ring = sqrt(qa * qa + qb * qb + 1e-4);
    const S lean = w - 0.25 * qa * qa * 0.6;
    S ear = ellipsoid(Vec<S>{lean, v, qa * 1.6}, {0, 0, 0}, {0.5, 2.95, 1.6});
    // helix: a rolled rim that fades into the lobe
    const S roll = 0.20 + 0.07 * ramp(v, -2.4, 0.4);
    const S helix = sqrt(square(S((ring - 0.90) * 1.9)) + square(S(lean - 0.24)) + 1e-4) - roll;
    ear = blend(ear, helix, 0.18);
    // antihelix: an inner fold behind the bowl
    ear = blend(ear, limb(Vec<S>{lean, v, u}, {0.18, -1.3, 0.35}, {0.18, 0.1, 0.75}, 0.29, 0.27), 0.25);
    ear = blend(ear, limb(Vec<S>{lean, v, u}, {0.18, 0.1, 0.75}, {0.10, 1.5, 0.25}, 0.27, 0.20), 0.25);
    // bowl, with the tragus before it and the lobe below
    ear = carve(ear, ellipsoid(Vec<S>{lean, v, u}, {0.66, -0.55, -0.25}, {0.60, 0.85, 0.62}), 0.3);
    ear = blend(ear, ellipsoid(Vec<S>{w, v, u}, {0.25, -0.75, -0.95}, {0.28, 0.45, 0.3}), 0.3);
    ear = blend(ear, ellipsoid(Vec<S>{w, v, u}, {0.12, -2.2, -0.15}, {0.32, 0.6, 0.6}), 0.35);
    // root
    d = blend(d, ellipsoid(q, {5.9, -2.0, -1.0}, {0.9, 2.4, 1.2}), 1.2);
    return blend(d, ear, 0.8);
}

/// Negative inside, about the distance near the surface. x to the head's left, y up, z forwards, in
/// centimetres; the pupils are at height 0.
template <class S>
S head_sculpture(const Vec<S>& p) {
    const Vec<S> q{soft_abs(p.x, 0.3), p.y, p.z};
    S d = skull(p, q);
    d = blend(d, face(p, q), 2.2);
    d = blend(d, neck(p, q), 1.6);
    d = with_sockets(d, p, q);
    d = with_nose(d, p, q);
    d = with_mouth(d, p, q);
    d = with_eyes(d, q);
    d = with_ears(d, q);
    return carve(d, S(p.y + 17.0), 2.4);
}

}  // namespace automorph::sculpt
