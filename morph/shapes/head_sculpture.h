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
    S d = ellipsoid(p, {0, 3.5, -2.5}, {7.5, 7.6, 7.3});
    d = blend(d, ellipsoid(p, {0, 3.3, 1.8}, {6.3, 7.2, 7.0}), 4.0);
    // occiput
    d = blend(d, ellipsoid(p, {0, 0.3, -5.2}, {5.2, 4.6, 4.3}), 3.0);
    // frontal eminences, flat temples and the line above them
    d = swell(d, q, {2.6, 5.6, 7.4}, {3.6, 3.4, 3.4}, 0.22);
    d = swell(d, q, {6.9, 1.2, 4.2}, {3.2, 4.2, 4.4}, -0.75);
    return swell(d, q, {6.4, 5.6, -2.6}, {4.5, 4.0, 5.5}, 0.25);
}

template <class S>
S face(const Vec<S>& p, const Vec<S>& q) {
    static const Turn masseter = turn(-14, 0, -8), malar = turn(0, 38, -16);
    static const Strand arch({{{4.6, -2.0, 5.6}, 0.8}, {{5.75, -1.8, 3.2}, 0.5}, {{5.9, -1.2, 0.0}, 0.35}});
    static const Strand mandible({{{5.3, -2.5, -0.6}, 0.8},
                                  {{4.6, -6.2, -0.1}, 0.9},
                                  {{3.75, -8.0, 1.6}, 0.9},
                                  {{2.1, -9.7, 5.0}, 0.95},
                                  {{0.7, -10.4, 7.2}, 1.1}});
    // maxilla and the barrel of the teeth
    S d = ellipsoid(p, {0, -3.0, 2.6}, {5.6, 6.8, 6.15});
    d = blend(d, ellipsoid(p, {0, -6.5, 4.6}, {3.9, 4.5, 5.0}), 2.2);
    // mandible, with the muscle on its ramus
    d = blend(d, strand(q, mandible), 1.8);
    d = blend(d, ellipsoid(q, {4.55, -4.8, 1.8}, {1.25, 3.5, 2.6}, masseter), 2.2);
    // floor of the mouth
    d = blend(d, ellipsoid(p, {0, -8.4, 2.8}, {3.3, 1.9, 4.2}), 2.0);
    // cheekbone and arch
    d = blend(d, ellipsoid(q, {3.9, -2.3, 5.6}, {2.3, 1.6, 1.9}, malar), 2.2);
    d = blend(d, strand(q, arch), 1.8);
    d = blend(d, ellipsoid(q, {4.9, -3.4, 1.8}, {1.1, 2.6, 2.8}), 2.0);
    // cheeks, and the rim of the orbit at its outer side
    d = blend(d, ellipsoid(q, {3.1, -4.9, 5.3}, {2.2, 3.1, 2.7}), 2.0);
    d = blend(d, limb(q, {4.85, 1.5, 5.5}, {4.75, -1.4, 5.8}, 0.6, 0.8), 1.8);
    // cheek up to the lower lid
    d = blend(d, ellipsoid(q, {3.2, -1.9, 6.55}, {1.9, 1.0, 1.2}), 1.3);
    // muzzle: what the lips lie on
    d = blend(d, ellipsoid(p, {0, -6.4, 7.3}, {2.65, 2.6, 2.15}), 1.8);
    // chin
    d = blend(d, ellipsoid(q, {0.5, -10.1, 7.75}, {1.25, 1.3, 1.4}), 1.7);
    return d;
}

template <class S>
S neck(const Vec<S>& p, const Vec<S>& q) {
    static const Strand sternomastoid({{{5.0, -3.0, -2.8}, 0.8},
                                       {{4.3, -8.5, -1.9}, 0.8},
                                       {{2.9, -14.0, -0.2}, 0.75},
                                       {{0.9, -20.0, 0.9}, 0.6}});
    S d = limb(Vec<S>{p.x * 1.02, p.y, p.z}, {0, -3.0, -2.6}, {0, -20.0, -4.8}, 4.2, 5.0);
    d = blend(d, strand(q, sternomastoid), 2.6);
    // larynx
    d = blend(d, limb(p, {0, -12.0, 0.7}, {0, -20.0, -0.2}, 1.0, 1.0), 2.0);
    d = swell(d, p, {0, -13.6, 2.2}, {1.6, 2.0, 1.8}, 0.14);
    // trapezius
    d = blend(d, limb(q, {1.8, 0.0, -4.4}, {4.4, -21.0, -6.6}, 1.4, 2.2), 3.0);
    return d;
}

/// The neck ends in an oval, cut level.
template <class S>
S with_stand(const S& d, const Vec<S>& p) {
    if (value_of(p.y) > -11.5) return d;
    const S oval = limb(p, {0, -10.0, -3.4}, {0, -30.0, -5.8}, 5.5, 6.7), share = ramp(p.y, -11.5, -17.0);
    return carve(S(d + share * (oval - d)), S(p.y + 17.0), 2.0);
}

// ---- eyes ------------------------------------------------------------------------------------------
inline constexpr Vec3 kEye{3.12, 0.0, 6.85};
inline constexpr Vec3 kEyeball{1.50, 1.34, 1.34}, kLids{1.78, 1.58, 1.58};  // semi-axes

template <class S>
S with_sockets(S d, const Vec<S>& p, const Vec<S>& q) {
    static const Strand brow({{{1.1, 1.45, 8.15}, 0.7}, {{2.9, 2.0, 7.85}, 0.62}, {{4.6, 1.55, 6.35}, 0.5}});
    d = blend(d, strand(q, brow), 1.5);
    d = blend(d, ellipsoid(p, {0, 1.8, 8.1}, {1.5, 1.0, 0.95}), 1.6);
    if (!near(q, {3.2, 0, 8.0}, 5.0)) return d;
    static const Turn socket = turn(0, 18, -8);
    return carve(d, ellipsoid(q, {2.85, 0.2, 9.0}, {2.0, 1.05, 1.55}, socket), 1.4);
}

template <class S>
S with_eyes(S d, const Vec<S>& q) {
    if (!near(q, kEye, 3.4)) return d;
    const S x = q.x - kEye.x, y = q.y - kEye.y;
    // Lids: a shell about the eyeball, softly joined below and to the sides, with a crease above it.
    const S k = 0.30 + 0.8 * ramp(S(0.35 * soft_abs(x, 0.2) - y), -0.6, 0.8);
    d = blend(d, ellipsoid(q, kEye, kLids), k);
    // The fold of skin between brow and lid.
    static const Strand fold({{{1.5, 0.5, 7.0}, 0.30},
                              {{2.3, 1.25, 7.8}, 0.36},
                              {{3.4, 1.48, 7.8}, 0.44},
                              {{4.6, 0.95, 6.9}, 0.44},
                              {{5.2, 0.1, 5.6}, 0.4}});
    d = blend(d, strand(q, fold), 0.3);
    // Opening between the margins of the lids.
    const S s = (x + 0.03) * (1.0 / 1.44), arch = 1.0 - s * s, line = 0.10 * s - 0.02;
    const S upper = line + 0.64 * arch * (1.0 - 0.22 * s), lower = line - 0.48 * arch * (1.0 + 0.22 * s);
    const S opening = -blend(S(upper - y), S(y - lower), 0.08) * 0.85;
    const S front = kEye.z - q.z + 0.2;  // the back half stays
    d = carve(d, S(-blend(S(-opening), S(-front), 0.2)), 0.12);
    d = blend(d, ellipsoid(q, kEye, kEyeball), 0.17);
    // caruncle
    return blend(d, ellipsoid(q, {1.85, -0.08, 7.55}, {0.25, 0.14, 0.25}), 0.15);
}

// ---- nose ------------------------------------------------------------------------------------------
template <class S>
S with_nose(S d, const Vec<S>& p, const Vec<S>& q) {
    if (!near(q, {0, -2.2, 9.5}, 6.0)) return d;
    static const Turn hole = turn(-24, 16, -8);
    static const Strand bridge(
        {{{0, 1.2, 8.3}, 0.5}, {{0, 0.0, 8.55}, 0.42}, {{0, -1.6, 9.4}, 0.50}, {{0, -3.3, 10.4}, 0.60}});
    static const Strand wing({{{1.12, -4.85, 8.9}, 0.26},
                              {{1.40, -4.4, 9.3}, 0.36},
                              {{1.22, -4.0, 9.9}, 0.42},
                              {{0.66, -3.85, 10.5}, 0.44}});
    S n = strand(p, bridge);
    // side walls
    n = blend(n, ellipsoid(q, {0.38, -2.9, 8.75}, {0.95, 2.3, 1.2}), 1.1);
    // tip: two domes
    n = blend(n, ellipsoid(q, {0.26, -3.65, 10.68}, {0.56, 0.62, 0.76}), 0.6);
    n = blend(n, strand(q, wing), 0.5);
    // columella
    n = blend(n, limb(p, {0, -4.05, 10.8}, {0, -4.85, 9.5}, 0.34, 0.44), 0.45);
    d = blend(d, n, 0.8);
    return carve(d, ellipsoid(q, {0.70, -4.62, 10.0}, {0.26, 0.46, 0.55}, hole), 0.16);
}

// ---- mouth -----------------------------------------------------------------------------------------
template <class S>
S with_mouth(S d, const Vec<S>& p, const Vec<S>& q) {
    if (!near(p, {0, -7.0, 9.0}, 5.0)) return d;
    // Borders of the lips and the line where they meet, over the distance s from the middle (1 at the
    // corners).
    const S s = soft_abs(p.x, 0.12) * (1.0 / 2.65), s2 = s * s;
    const S in = ramp(s, 1.06, 0.6), left = 1.0 - s2, wide = 0.5 * (left + soft_abs(left, 0.15));
    const S meet =
        -6.95 + 0.02 * s2 + 0.07 * bump(S((s - 0.45) * (1.0 / 0.45))) - 0.06 * bump(S(s * (1.0 / 0.35)));
    const S top = meet + 0.08 + wide * 0.60 + 0.13 * bump(S((s - 0.26) * (1.0 / 0.36)));
    const S bottom = meet - 0.08 - wide * 0.92;
    // Heights above the face: t is 0 where the lips meet, 1 at the border.
    const S tu = (p.y - meet) / (top - meet), tl = (meet - p.y) / (meet - bottom);
    const S upper = ramp(tu, 1.35, 0.65) * (0.12 + 0.15 * ramp(tu, 0.0, 0.55)),
            lower = ramp(tl, 1.4, 0.6) * (0.12 + 0.25 * ramp(tl, 0.0, 0.55));
    const S high = value_of(tu) > 0 ? upper : lower;
    const S slit = bump(S((p.y - meet) * (1.0 / 0.20))) * ramp(s, 1.12, 0.8);
    d = d - (in * high - 0.16 * slit) * ramp(p.z, 6.5, 8.0);
    // philtrum and the furrow below
    d = carve(d, limb(p, {0, -5.0, 10.25}, {0, -6.1, 10.35}, 0.24, 0.34), 0.4);
    d = swell(d, p, {0, -8.7, 9.2}, {2.6, 0.95, 1.6}, -0.28);
    // fold from wing to corner
    d = d + 0.09 * bump(S(limb(q, {1.75, -4.5, 8.6}, {3.0, -6.9, 7.8}, 0.0, 0.0) * (1.0 / 0.8)));
    return swell(d, q, {2.75, -7.05, 8.6}, {0.8, 0.7, 0.9}, -0.12);
}

// ---- ears ------------------------------------------------------------------------------------------
template <class S>
S with_ears(S d, const Vec<S>& q) {
    if (!near(q, {7.2, -1.5, -1.5}, 7.5)) return d;
    static const Turn pose = turn(-14, -30, 4);
    // local: x outwards, y up, z forwards
    const Vec<S> e = local(q, {6.75, -1.3, -1.2}, pose);
    static const Strand helix({{{0.15, -0.35, 0.55}, 0.18},
                               {{0.30, 0.25, 1.05}, 0.24},
                               {{0.40, 1.3, 1.25}, 0.27},
                               {{0.45, 2.35, 0.75}, 0.28},
                               {{0.5, 2.8, -0.2}, 0.28},
                               {{0.55, 2.45, -1.2}, 0.28},
                               {{0.6, 1.4, -1.75}, 0.27},
                               {{0.6, 0.2, -1.75}, 0.25},
                               {{0.48, -0.9, -1.38}, 0.23},
                               {{0.30, -1.8, -0.95}, 0.25},
                               {{0.22, -2.45, -0.4}, 0.28}});
    static const Strand antihelix({{{0.2, -1.5, 0.35}, 0.22},
                                   {{0.36, -1.4, -0.2}, 0.28},
                                   {{0.45, -0.8, -0.85}, 0.27},
                                   {{0.5, 0.1, -1.0}, 0.28},
                                   {{0.42, 1.0, -0.7}, 0.27},
                                   {{0.22, 2.0, -0.2}, 0.2}});
    static const Strand crus(
        {{{0.45, 0.95, -0.65}, 0.24}, {{0.3, 1.05, 0.2}, 0.2}, {{0.2, 0.95, 0.8}, 0.14}});
    // Plate: egg-shaped, curved out towards the rim.
    const S up = e.y, back = -e.z;
    const S width = 1.62 + 0.13 * up;
    const S qa = (back - 0.28) / width, qb = (up - 0.1) * (1.0 / 2.85);
    const S r2 = qa * qa + qb * qb;
    const S lean = e.x - 0.12 - 0.28 * r2;
    S ear = ellipsoid(Vec<S>{lean, qb, qa}, {0, 0, 0}, {0.26, 1.0, 1.0});
    // back of the bowl
    ear = blend(ear, ellipsoid(e, {-0.15, -0.4, 0.05}, {0.5, 1.5, 1.15}), 0.4);
    ear = blend(ear, strand(e, helix), 0.26);
    ear = blend(ear, strand(e, antihelix), 0.32);
    ear = blend(ear, strand(e, crus), 0.18);
    // lobe, antitragus, tragus
    ear = blend(ear, ellipsoid(e, {0.25, -2.35, 0.15}, {0.28, 0.75, 0.72}), 0.35);
    // bowl
    ear = carve(ear, ellipsoid(e, {0.72, -0.5, 0.0}, {0.72, 0.95, 0.72}), 0.2);
    ear = blend(ear, ellipsoid(e, {0.42, -0.75, 0.85}, {0.28, 0.52, 0.30}), 0.3);
    // root
    d = blend(d, ellipsoid(q, {5.9, -2.2, -1.0}, {0.95, 2.8, 1.1}), 1.0);
    return blend(d, ear, 0.6);
}

/// Negative inside, about the distance near the surface. x to the head's left, y up, z forwards, in
/// centimetres; the pupils are at height 0.
template <class S>
S head_sculpture(const Vec<S>& p) {
    const Vec<S> q{soft_abs(p.x, 0.3), p.y, p.z};
    S d = skull(p, q);
    d = blend(d, face(p, q), 2.2);
    d = blend(d, neck(p, q), 2.8);
    d = with_sockets(d, p, q);
    d = with_nose(d, p, q);
    d = with_mouth(d, p, q);
    d = with_eyes(d, q);
    d = with_ears(d, q);
    return with_stand(d, p);
}

}  // namespace automorph::sculpt
