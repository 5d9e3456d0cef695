#include "morph/frame_check.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "morph/frames/self_intersection.h"
#include "morph/shapes/random.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

int crossing(const Mesh& mesh) {
    const SelfIntersections found = self_intersections(mesh);
    CHECK_FALSE(found.estimated);
    return found.triangles;
}

Mesh joined(const Mesh& a, const Mesh& b) {
    Mesh mesh{Points(a.V.rows() + b.V.rows(), 3), Triangles(a.F.rows() + b.F.rows(), 3)};
    mesh.V << a.V, b.V;
    mesh.F << a.F, (b.F.array() + a.vertex_count()).matrix();
    return mesh;
}

bool has_note(const Report& report, const std::string& text) {
    return std::any_of(report.notes.begin(), report.notes.end(), [&](const std::string& note) {
        return note.find("look at the frame") != std::string::npos && note.find(text) != std::string::npos;
    });
}

}  // namespace

TEST_CASE("two triangles cross where an edge of one goes through the other, and not where they touch") {
    Mesh pair{Points(6, 3), Triangles(2, 3)};
    pair.F << 0, 1, 2, 3, 4, 5;
    pair.V << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1, 5, 5, 0.5;
    CHECK(crossing(pair) == 2);
    pair.V.row(3) << 1, 1, 0.5;  // above
    CHECK(crossing(pair) == 0);
    pair.V.row(3) << 1, 1, 0;  // on it
    CHECK(crossing(pair) == 0);
    pair.V.bottomRows(3).col(0).array() += 10.0;  // far away
    CHECK(crossing(pair) == 0);
}

TEST_CASE("a sphere does not cross itself, two that overlap cross along a ring") {
    const Mesh ball = ellipsoid({1, 1, 1}, {.triangles = 2000});
    CHECK(crossing(ball) == 0);
    Mesh other = ball;
    other.V.col(0).array() += 0.7;
    const int both = crossing(joined(ball, other));
    // A ring of circumference 2 pi 0.94 over edges of some 0.12, on both.
    CHECK(both > 100);
    CHECK(both < 500);
    other.V.col(0).array() += 1.5;
    CHECK(crossing(joined(ball, other)) == 0);
}

TEST_CASE("where too many boxes overlap the count is an estimate, and says so") {
    // Triangles of random corners: nearly all pass through others.
    Random random(3);
    Mesh tangle{Points(3 * 3000, 3), Triangles(3000, 3)};
    for (int v = 0; v < tangle.V.rows(); ++v) tangle.V.row(v) = random.in_ball<3>();
    for (int f = 0; f < 3000; ++f) tangle.F.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
    const SelfIntersections all = self_intersections(tangle), some = self_intersections(tangle, 1e5);
    CHECK_FALSE(all.estimated);
    CHECK(all.triangles > 2900);
    CHECK(some.estimated);
    CHECK(std::abs(some.triangles - all.triangles) < 100);

    // One in two, by place: half of them far apart, each alone.
    for (int f = 0; f < 3000; f += 2) {
        for (int k = 0; k < 3; ++k) tangle.V(3 * f + k, 0) += 10.0 * (f + 1);
    }
    const SelfIntersections half = self_intersections(tangle, 1e5);
    CHECK(half.estimated);
    CHECK(half.triangles > 1200);
    CHECK(half.triangles < 1800);
}

TEST_CASE("where a mesh lies and how large it is makes no difference to what crosses") {
    const Mesh ball = ellipsoid({1, 1, 1}, {.triangles = 2000});
    Mesh other = ball;
    other.V.col(0).array() += 0.7;
    const Mesh both = joined(ball, other);
    const int here = crossing(both);
    for (const double scale : {1e-150, 1e150}) CHECK(crossing({scale * both.V, both.F}) == here);
    // Floats at 1e9 are 64 apart.
    CHECK(std::abs(crossing({both.V.array() + 1e9, both.F}) - here) < 0.1 * here);
    CHECK(crossing({ball.V.array() + 1e9, ball.F}) == 0);
}

TEST_CASE("a shape and its turned copy: frames are clean, and nothing is noted") {
    const Mesh a = star({.arms = 4, .inner = 0.6, .depth = 0.5}, {.triangles = 2000, .seed = 1});
    Mesh b = a;
    b.V = b.V * Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitZ()).toRotationMatrix().transpose();
    const Morph result = morph(admit_mesh(a), admit_mesh(b));
    const Report report = report_with_frames(result);
    REQUIRE(report.frames.size() == 7);
    for (const FrameReport& frame : report.frames) {
        CHECK(frame.reversed == 0);
        CHECK(frame.self_intersecting == 0);
        CHECK(frame.area_ratio == Approx(1.0).epsilon(1e-3));
        CHECK(frame.volume_ratio == Approx(1.0).epsilon(1e-3));
        CHECK(frame.smallest_angle > 0.0);
    }
    CHECK_FALSE(has_note(report, ""));
}

TEST_CASE("a linear morph through half a turn collapses, and the report says where") {
    // Turned by 170 degrees about z, Eq. (12) shrinks the middle to a needle.
    const Mesh a = ellipsoid({1.0, 0.7, 0.5}, {.triangles = 2000});
    Mesh c = a;
    c.V.col(2).array() += 0.2 * c.V.col(0).array().square();
    c.V.col(1).array() += 0.3 * c.V.col(0).array().square() + 0.2 * c.V.col(0).array();
    Mesh d = c;
    d.V = c.V * Eigen::AngleAxisd(2.9, Eigen::Vector3d::UnitZ()).toRotationMatrix().transpose();
    const Morph result = morph(admit_mesh(c), admit_mesh(d));
    const Report linear = report_with_frames(result, Interpolation::Linear),
                 slerped = report_with_frames(result, Interpolation::Slerp);
    CHECK(has_note(linear, "area"));
    CHECK(has_note(linear, "volume"));
    CHECK_FALSE(has_note(slerped, ""));
    CHECK(report_json(linear).find("\"frames\"") != std::string::npos);
}
