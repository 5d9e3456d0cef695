#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "morph/mesh/errors.h"
#include "morph/shapes/head.h"
#include "morph/shapes/head_sculpture.h"

// p goes to p + sum of displacements, all evaluated at the neutral p. Each is a linear or constant motion
// about an anatomical centre times a window: 1 at its centre, 0 beyond its semi-axes, C2. Centimetres inside.

namespace automorph {

namespace {

using namespace sculpt;
using P = HeadParameters;

constexpr double kShift = 0.01 * kHeadHeight;  // a hundredth, cm

/// Collects the motion of one point.
template <class S>
struct Motion {
    Vec<S> at;      // neutral
    Vec<S> folded;  // with |x|
    Vec<S> moved;
    S side;  // d |x| / dx: turns a motion of the left half into that of the point

    explicit Motion(const Vec<S>& p)
        : at(p), folded{soft_abs(p.x, 0.5), p.y, p.z}, moved(p), side(p.x / soft_abs(p.x, 0.5)) {}

    S window(const Vec3& c, const Vec3& r) const {
        return bump_square(
            S(square(S((at.x - c.x) / r.x)) + square(S((at.y - c.y) / r.y)) + square(S((at.z - c.z) / r.z))));
    }
    S paired(const Vec3& c, const Vec3& r) const {
        return bump_square(S(square(S((folded.x - c.x) / r.x)) + square(S((folded.y - c.y) / r.y)) +
                             square(S((folded.z - c.z) / r.z))));
    }
    void shift(const S& weight, double x, double y, double z) {
        if (x != 0.0) moved.x = moved.x + weight * side * x;
        if (y != 0.0) moved.y = moved.y + weight * y;
        if (z != 0.0) moved.z = moved.z + weight * z;
    }
    /// Scales by 1 + factor about a centre on the plane of symmetry.
    void stretch(const S& weight, const Vec3& c, double x, double y, double z) {
        if (x != 0.0) moved.x = moved.x + weight * x * at.x;
        if (y != 0.0) moved.y = moved.y + weight * y * (at.y - c.y);
        if (z != 0.0) moved.z = moved.z + weight * z * (at.z - c.z);
    }
    void stretch_pair(const S& weight, const Vec3& c, double x, double y, double z) {
        if (x != 0.0) moved.x = moved.x + weight * side * x * (folded.x - c.x);
        if (y != 0.0) moved.y = moved.y + weight * y * (at.y - c.y);
        if (z != 0.0) moved.z = moved.z + weight * z * (at.z - c.z);
    }
};

template <class S>
Vec<S> deform(const P& h, const Vec<S>& p) {
    Motion<S> m(p);
    const Vec3 eye{3.15, 0, 7.0}, mouth{0, -7.0, 9.5};

    // The whole, with ramps that keep the other parts.
    const S above = ramp(p.y, -2.0, 5.0), below = 1.0 - ramp(p.y, -4.0, 0.0);
    m.stretch(ramp(p.y, -6.0, 3.0), {0, 0, 0}, h.head_width - 1, 0, 0);
    m.stretch(above, {0, 0, 0}, 0, h.head_height - 1, 0);
    m.stretch(S(ramp(p.y, -8.0, 1.0) * (1.0 - ramp(p.z, -1.0, 7.0))), {0, 0, 3}, 0, 0, h.head_length - 1);
    // Soft through the level of the eyes, the chin's motion carried on by what is below it.
    m.stretch(below, {0, -2.0, 0}, 0, (h.face_height - 1) * 1.2, 0);
    m.stretch(S(1.0 - ramp(p.y, -13.0, -8.0)), {0, 0, 0}, h.neck_width - 1, 0, 0);
    m.stretch(S(1.0 - ramp(p.y, -13.0, -8.0)), {0, -12, -3}, 0, 0, h.neck_width - 1);

    // Face and jaw.
    m.stretch(m.window({0, -1.5, 3.0}, {12, 8.5, 11}), {0, 0, 0}, (h.face_width - 1) * 1.15, 0, 0);
    m.stretch(m.window({0, -9.0, 3.5}, {12, 7.0, 11}), {0, 0, 0}, (h.jaw_width - 1) * 1.15, 0, 0);
    m.shift(m.window({0, 6.5, 8.0}, {8, 5.5, 6}), 0, 0, h.forehead * kShift);
    m.shift(m.paired({2.6, 1.9, 8.8}, {4.2, 2.2, 3.2}), 0, 0, h.brow_ridge * kShift);
    m.shift(m.paired({4.9, -2.2, 6.0}, {3.4, 3.4, 5.0}), 0.6 * h.cheekbones * kShift, 0,
            h.cheekbones * kShift);
    m.shift(m.paired({4.2, -5.6, 5.6}, {3.2, 4.0, 5.2}), 0.9 * h.cheeks * kShift, 0, 0.5 * h.cheeks * kShift);
    m.shift(m.window({0, -10.4, 8.6}, {4.5, 3.4, 5.0}), 0, 0, h.chin * kShift);

    // Eyes.
    const S eyes = m.paired(eye, {3.1, 2.6, 3.6});
    m.shift(eyes, eye.x * (h.eye_distance - 1), 0, 0);
    m.stretch_pair(eyes, eye, h.eye_size - 1, h.eye_size - 1, h.eye_size - 1);
    m.stretch_pair(m.paired({3.15, 0, 8.0}, {2.4, 1.5, 1.6}), eye, 0, h.eye_opening - 1, 0);
    const S tilt = m.paired({3.1, 0.1, 7.7}, {2.9, 2.0, 2.6});
    m.moved.y = m.moved.y + tilt * (m.folded.x - eye.x) * (h.eye_tilt * kShift / 3.0);
    m.shift(m.paired({3.0, 1.05, 8.3}, {2.2, 1.15, 1.7}), 0, -0.55 * h.lid_fullness * kShift,
            h.lid_fullness * kShift);
    m.shift(m.paired({1.75, 0.35, 8.1}, {0.95, 0.95, 1.3}), 0.2 * h.lid_fullness * kShift,
            -0.3 * h.lid_fullness * kShift, 0.3 * h.lid_fullness * kShift);

    // Nose.
    const S nose = m.window({0, -3.0, 10.2}, {3.0, 4.2, 4.0});
    m.stretch(nose, {0, 0.6, 9}, 0, (h.nose_length - 1) * 0.9, 0);
    m.stretch(m.window({0, -4.0, 10.2}, {3.4, 2.9, 3.4}), {0, 0, 0}, (h.nose_width - 1) * 1.1, 0, 0);
    m.shift(m.window({0, 0.2, 9.4}, {1.9, 3.4, 2.6}), 0, 0, h.nose_bridge * kShift);
    m.shift(m.window({0, -3.6, 11.4}, {2.2, 3.2, 3.4}), 0, 0, h.nose_protrusion * kShift);
    m.shift(m.window({0, -4.0, 11.4}, {2.0, 1.9, 2.6}), 0, h.nose_tip * kShift, 0);

    // Mouth.
    m.stretch(m.window(mouth, {4.6, 2.6, 4.0}), mouth, (h.mouth_width - 1) * 1.2, 0, 0);
    m.stretch(m.window(mouth, {4.0, 1.9, 2.8}), mouth, 0, (h.lip_fullness - 1) * 0.9, 0);
    m.shift(m.window({0, -7.0, 10.4}, {3.4, 1.7, 2.4}), 0, 0, (h.lip_fullness - 1) * 0.8);

    // Ears.
    m.stretch_pair(m.paired({7.2, -1.5, -1.5}, {3.2, 5.6, 4.6}), {6.6, -1.5, -0.6}, 0.6 * (h.ear_size - 1),
                   h.ear_size - 1, h.ear_size - 1);
    return m.moved;
}

void check(const P& parameters) {
    for (const HeadParameter& each : kHeadParameters) {
        const double found = parameters.*each.member;
        if (!(found >= each.least && found <= each.most)) {
            throw InvalidMesh(fmt::format("head: {} is {:g}, expected {:g} to {:g}", each.name, found,
                                          each.least, each.most));
        }
    }
}

/// The place and, by column, the derivative of the deformation.
struct Deformed {
    Eigen::Vector3d place;
    Eigen::Matrix3d derivative;
};
Deformed with_derivative(const P& parameters, const Eigen::Vector3d& p) {
    const Vec<Jet> moved =
        deform(parameters, Vec<Jet>{Jet(p.x(), 1, 0, 0), Jet(p.y(), 0, 1, 0), Jet(p.z(), 0, 0, 1)});
    Deformed result;
    result.place << moved.x.value, moved.y.value, moved.z.value;
    result.derivative << moved.x.x, moved.x.y, moved.x.z, moved.y.x, moved.y.y, moved.y.z, moved.z.x,
        moved.z.y, moved.z.z;
    return result;
}

/// The neutral point that goes to `place`, both in centimetres.
Eigen::Vector3d undo(const P& parameters, const Eigen::Vector3d& place) {
    constexpr int kMaxSteps = 80, kMaxHalvings = 20;
    constexpr double kClose = 1e-13 * kHeadHeight;
    Eigen::Vector3d p = place;
    Deformed here = with_derivative(parameters, p);
    double error = (here.place - place).norm();
    for (int step = 0; step < kMaxSteps; ++step) {
        if (error <= kClose) return p;
        const Eigen::Vector3d move = here.derivative.partialPivLu().solve(place - here.place);
        bool is_better = false;
        for (int k = 0; k <= kMaxHalvings && !is_better; ++k) {
            const Eigen::Vector3d next = p + std::ldexp(1.0, -k) * move;
            const Deformed there = with_derivative(parameters, next);
            const double left = (there.place - place).norm();
            if (!(left < error)) continue;
            is_better = true;
            p = next;
            here = there;
            error = left;
        }
        if (!is_better) break;
    }
    if (error <= 100.0 * kClose) return p;  // rounding
    throw SolverFailure(fmt::format("no point of the neutral head goes to ({:g} {:g} {:g})",
                                    place.x() / kHeadHeight, place.y() / kHeadHeight,
                                    place.z() / kHeadHeight));
}

}  // namespace

Eigen::Vector3d deform_head(const HeadParameters& parameters, const Eigen::Vector3d& neutral) {
    check(parameters);
    const Eigen::Vector3d p = kHeadHeight * neutral;
    const Vec3 moved = deform(parameters, Vec3{p.x(), p.y(), p.z()});
    return Eigen::Vector3d(moved.x, moved.y, moved.z) / kHeadHeight;
}

double head_deformation_determinant(const HeadParameters& parameters, const Eigen::Vector3d& neutral) {
    check(parameters);
    return with_derivative(parameters, kHeadHeight * neutral).derivative.determinant();
}

Points corresponding_head_points(const Points& points, const HeadParameters& from, const HeadParameters& to) {
    check(from);
    check(to);
    Points result(points.rows(), 3);
    for (Eigen::Index v = 0; v < points.rows(); ++v) {
        const Eigen::Vector3d place = kHeadHeight * points.row(v).transpose();
        result.row(v) = deform_head(to, undo(from, place) / kHeadHeight).transpose();
    }
    return result;
}

}  // namespace automorph
