#pragma once

#include "morph/shapes/sculpt.h"

/// The neutral head as a field in centimetres.
namespace automorph::sculpt {

// ---- masses: cranium, face, jaw, neck --------------------------------------------------------------
template <class S>
S skull(const Vec<S>& p, const Vec<S>& q) {  // q: x folded
    S d = ellipsoid(p, {0, 3.7, -2.2}, {7.55, 7.5, 7.5});
    d = blend(d, ellipsoid(p, {0, 3.6, 1.6}, {6.3, 7.3, 7.55}), 4.0);
    // temples
    d = carve(d, ellipsoid(q, {8.6, 1.2, 5.0}, {1.9, 3.2, 3.4}), 2.0);
    return d;
}

template <class S>
S face(const Vec<S>& p, const Vec<S>& q) {
    static const Turn masseter = turn(-16, 0, -6), malar = turn(0, 38, -18);
    // maxilla and the barrel of the teeth
    S d = ellipsoid(p, {0, -3.2, 2.6}, {5.6, 7.2, 6.2});
    d = blend(d, ellipsoid(p, {0, -6.4, 4.9}, {3.9, 4.6, 4.95}), 2.0);
    // mandible
    d = blend(d, limb(q, {4.6, -7.6, 0.6}, {1.2, -10.0, 7.2}, 1.0, 1.35), 1.8);
    d = blend(d, ellipsoid(q, {4.75, -5.3, 2.2}, {1.5, 4.0, 2.5}, masseter), 2.0);
    // cheekbone and arch
    d = blend(d, ellipsoid(q, {4.25, -2.1, 5.6}, {2.1, 1.35, 1.6}, malar), 2.2);
    d = blend(d, limb(q, {5.2, -1.5, 4.6}, {6.3, -1.0, 0.2}, 0.75, 0.55), 1.8);
    // chin
    d = blend(d, ellipsoid(q, {0.45, -10.15, 8.3}, {1.5, 1.25, 1.5}), 1.6);
    return d;
}

template <class S>
S neck(const Vec<S>& p, const Vec<S>& q) {
    S d = limb(Vec<S>{p.x * 1.04, p.y, p.z}, {0, -4.0, -2.6}, {0, -19.0, -3.6}, 5.2, 5.7);
    d = blend(d, limb(q, {5.3, -4.2, -1.6}, {1.0, -19.0, 3.0}, 0.9, 0.9), 1.6);
    d = blend(d, ellipsoid(p, {0, -14.2, 1.6}, {1.3, 2.0, 1.3}), 1.5);
    // shoulders begin
    d = blend(d, limb(q, {4.2, -13.0, -5.2}, {9.5, -20.0, -5.0}, 1.6, 2.4), 3.0);
    return d;
}

// ---- eyes ------------------------------------------------------------------------------------------
inline constexpr Vec3 kEye{3.15, 0.0, 6.95};
inline constexpr double kEyeball = 1.22, kLid = 1.43;

template <class S>
S with_sockets(S d, const Vec<S>& p, const Vec<S>& q) {
    static const Turn brow_turn = turn(0, 0, 0);
    (void)brow_turn;
    // brow ridge
    d = blend(d, limb(q, {1.0, 1.75, 8.55}, {4.7, 1.75, 6.3}, 0.85, 0.6), 1.4);
    d = blend(d, ellipsoid(p, {0, 1.9, 8.5}, {1.6, 0.9, 1.0}), 1.4);
    if (!near(q, {3.2, 0, 8.0}, 5.0)) return d;
    static const Turn socket = turn(0, 16, -8);
    d = carve(d, ellipsoid(q, {3.0, 0.05, 8.9}, {2.05, 1.15, 1.55}, socket), 1.1);
    return d;
}

template <class S>
S with_eyes(S d, const Vec<S>& q) {
    if (!near(q, kEye, 3.4)) return d;
    const S x = q.x - kEye.x, y = q.y - kEye.y;
    // Lids: a shell about the eyeball; softly joined below, with a crease above.
    const S soft = ramp(S(-1.0 * y), -0.6, 0.6);
    const double k = 0.22 + 0.75 * value_of(soft);
    d = blend(d, ellipsoid(q, kEye, {kLid + 0.12, kLid, kLid}), k);
    // Opening between the margins of the lids.
    const S s = (x + 0.05) * (1.0 / 1.52), arch = 1.0 - s * s, line = 0.10 * s - 0.02;
    const S upper = line + 0.60 * arch * (1.0 - 0.22 * s), lower = line - 0.44 * arch * (1.0 + 0.22 * s);
    const S opening = -blend(S(upper - y), S(y - lower), 0.08) * 0.85;
    const S front = kEye.z - q.z + 0.2;  // the back half stays
    d = carve(d, S(-blend(S(-opening), S(-front), 0.2)), 0.09);
    d = blend(d, ellipsoid(q, kEye, {kEyeball, kEyeball, kEyeball}), 0.04);
    // caruncle
    d = blend(d, ellipsoid(q, {1.82, -0.1, 7.62}, {0.25, 0.16, 0.25}), 0.15);
    return d;
}

// ---- nose ------------------------------------------------------------------------------------------
template <class S>
S with_nose(S d, const Vec<S>& p, const Vec<S>& q) {
    if (!near(q, {0, -2.2, 9.5}, 6.0)) return d;
    static const Turn wing = turn(-12, 22, 8), hole = turn(-20, 12, 0);
    S n = limb(p, {0, 0.9, 8.35}, {0, -3.2, 10.3}, 0.78, 0.95);
    n = blend(n, ellipsoid(p, {0, -3.75, 10.95}, {0.92, 0.8, 0.95}), 0.7);
    n = blend(n, ellipsoid(q, {0.95, -3.0, 9.2}, {0.9, 1.7, 1.2}), 0.8);
    n = blend(n, ellipsoid(q, {1.15, -4.15, 9.75}, {0.62, 0.66, 0.95}, wing), 0.45);
    n = blend(n, limb(p, {0, -4.2, 10.9}, {0, -4.7, 9.8}, 0.42, 0.42), 0.5);
    d = blend(d, n, 0.8);
    return carve(d, ellipsoid(q, {0.58, -4.85, 10.25}, {0.30, 0.5, 0.55}, hole), 0.3);
}

// ---- mouth -----------------------------------------------------------------------------------------
template <class S>
S with_mouth(S d, const Vec<S>& p, const Vec<S>& q) {
    if (!near(p, {0, -7.0, 9.5}, 4.6)) return d;
    using std::sqrt;
    const S x2 = p.x * p.x;
    const S across = x2 * (1.0 / (2.7 * 2.7));
    const S taper = bump_square(S(across * 0.8));
    const S line = -7.0 + 0.10 * bump_square(S(x2 * (1.0 / 0.36))) * -1.0 + 0.05 * across - 0.12 * across * across;
    const S front = 9.75 - 0.21 * x2;
    // philtrum
    d = carve(d, limb(p, {0, -5.0, 10.35}, {0, -6.1, 10.75}, 0.32, 0.42), 0.4);
    const auto tube = [&](const S& cy, const S& cz, const S& a, const S& b) {
        const S u = (p.y - cy) / a, v = (p.z - cz) / b;
        return (sqrt(u * u + v * v + 1e-6) - 1.0) * 0.45;
    };
    const S size = 0.25 + 0.75 * taper;
    const S bow = bump_square(S(x2 * (1.0 / 0.30))) * -0.10;
    d = blend(d, tube(line + 0.36 * size + bow, front + 0.1, 0.48 * size, 0.62 * size), 0.35);
    d = blend(d, tube(line - 0.42 * size, front - 0.05, 0.56 * size, 0.70 * size), 0.35);
    // line where the lips meet
    const S slit = sqrt(square(S(p.y - line)) + 0.0004) - 0.05;
    const S inside = front + 0.05 - p.z;
    (void)inside;
    const S width = soft_abs(p.x, 0.05) - 2.55;
    const S deep = 0.35 - (p.z - front);
    S cut = -blend(S(-slit), S(-width), 0.1);
    cut = -blend(S(-cut), S(-deep), 0.1);
    d = carve(d, cut, 0.16);
    (void)q;
    return d;
}

// ---- ears ------------------------------------------------------------------------------------------
template <class S>
S with_ears(S d, const Vec<S>& q) {
    if (!near(q, {7.2, -1.5, -1.5}, 5.6)) return d;
    using std::sqrt;
    static const Turn pose = turn(-10, -24, 6);
    // local: x outwards, y up, z forwards
    const Vec<S> e = local(q, {7.0, -1.4, -1.5}, pose);
    const S w = e.x, v = e.y, u = -e.z;  // out, up, back
    // egg outline: wider above
    const S width = 1.75 + 0.16 * v;
    const S qa = (u - 0.05) / width, qb = v * (1.0 / 3.05);
    const S ring = sqrt(qa * qa + qb * qb + 1e-4);
    // plate
    S ear = -blend(S(-(ring - 1.0) * 1.6), S(0.28 - soft_abs(S(w - 0.1), 0.1)), 0.3);
    // helix
    const S rim = ramp(v, -2.2, 0.5) * 0.16 + 0.17;
    const S helix = sqrt(square(S((ring - 0.93) * 2.0)) + square(S(w - 0.38)) + 1e-4) - rim;
    ear = blend(ear, helix, 0.15);
    // concha
    ear = carve(ear, ellipsoid(Vec<S>{w, v, u}, {0.55, -0.55, -0.35}, {0.65, 1.0, 0.75}), 0.25);
    return blend(d, ear, 0.5);
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
    return carve(d, S(p.y + 17.0), 1.0);
}

}  // namespace automorph::sculpt
