#include "morph/alignment/limbs.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "morph/alignment/geodesic.h"
#include "morph/alignment/nonrigid.h"
#include "morph/alignment/places.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/geometry.h"
#include "morph/morph.h"
#include "morph/shapes/head.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;
using Eigen::Vector3d;

namespace {

constexpr int kArms = 5;

/// Five arms of different lengths, the first along x; no symmetry hides a wrong answer.
Points lengthened(Points V) {
    constexpr std::array<double, kArms> kLonger{1.0, 1.35, 0.9, 1.2, 1.05};
    for (Eigen::Index v = 0; v < V.rows(); ++v) {
        const double turn = std::atan2(V(v, 1), V(v, 0)) / (2.0 * std::numbers::pi);
        const auto arm =
            static_cast<std::size_t>(std::lround(kArms * (turn < 0.0 ? turn + 1.0 : turn))) % kArms;
        const double r = std::hypot(V(v, 0), V(v, 1)), outside = std::max(0.0, r - 0.4);
        if (r > 0.0) V.row(v).head<2>() *= 1.0 + (kLonger[arm] - 1.0) * outside / r;
    }
    return V;
}

Mesh limbed(std::uint64_t seed, int triangles = 5000) {
    Mesh mesh = star({.arms = kArms, .inner = 0.33, .depth = 0.25}, {.triangles = triangles, .seed = seed});
    mesh.V = lengthened(mesh.V);
    return mesh;
}

/// The arms swung by as many radians about z, and raised by others; the body stays. Continuous, as beyond the
/// valleys, at a radius of 0.33, there are only arms.
Points swung(Points V, const std::array<double, kArms>& sideways, const std::array<double, kArms>& up) {
    for (Eigen::Index v = 0; v < V.rows(); ++v) {
        const double turn = std::atan2(V(v, 1), V(v, 0)) / (2.0 * std::numbers::pi);
        const auto arm =
            static_cast<std::size_t>(std::lround(kArms * (turn < 0.0 ? turn + 1.0 : turn))) % kArms;
        const double s = std::clamp((std::hypot(V(v, 0), V(v, 1)) - 0.33) / 0.4, 0.0, 1.0);
        const double bent = s * s * (3.0 - 2.0 * s),
                     angle = 2.0 * std::numbers::pi * static_cast<double>(arm) / kArms;
        const Vector3d along(std::cos(angle), std::sin(angle), 0.0), across(-along.y(), along.x(), 0.0);
        const Vector3d root = 0.33 * along;
        const Eigen::Matrix3d R = (Eigen::AngleAxisd(bent * sideways[arm], Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(-bent * up[arm], across))
                                      .toRotationMatrix();
        V.row(v) = root + R * (V.row(v).transpose() - root);
    }
    return V;
}

constexpr std::array<double, kArms> kSideways{0.5, -0.5, 0.0, 0.45, -0.4}, kUp{0.3, 0.0, 0.8, -0.4, 0.5};

Vector3d tip_of_arm(const Mesh& mesh, int arm) {
    const double angle = 2.0 * std::numbers::pi * arm / kArms;
    Eigen::Index v = 0;
    (mesh.V * Vector3d(std::cos(angle), std::sin(angle), 0.0)).maxCoeff(&v);
    return mesh.V.row(v);
}

/// Mean distance of a morph's correspondence from the truth, in percent of the diagonal.
double mean_off(const Points& found, const Points& truth) {
    return 100.0 * (found - truth).rowwise().norm().mean() / bounding_box_diagonal(truth);
}

}  // namespace

TEST_CASE(
    "distances along a ball are angles, along a plane straight lines, and there is none to another part") {
    const Mesh ball = ellipsoid({1, 1, 1}, {.triangles = 4000});
    const Eigen::VectorXd distance = SurfaceDistances(ball).from({7});
    double most = 0.0;
    for (int v = 0; v < ball.vertex_count(); ++v) {
        const double angle = std::acos(std::clamp(ball.V.row(v).dot(ball.V.row(7)), -1.0, 1.0));
        CHECK(distance[v] >= 0.99 * angle);  // chords are a little shorter
        most = std::max(most, distance[v] - angle);
    }
    CHECK(most < 0.05 * std::numbers::pi);

    // A strip of thin triangles: edges alone would zigzag.
    constexpr int kColumns = 40;
    Mesh strip{Points(2 * kColumns + 1, 3), Triangles(2 * kColumns - 2, 3)};
    for (int i = 0; i < kColumns; ++i) {
        strip.V.row(2 * i) << 0.1 * i, 0, 0;
        strip.V.row(2 * i + 1) << 0.1 * i, 1, 0;
    }
    strip.V.row(2 * kColumns) << 0, 0, 5;
    for (int i = 0; i + 1 < kColumns; ++i) {
        strip.F.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 1;
        strip.F.row(2 * i + 1) << 2 * i + 2, 2 * i + 3, 2 * i + 1;
    }
    const Eigen::VectorXd along = SurfaceDistances(strip).from({0});
    CHECK(along[2 * kColumns - 2] == Approx(3.9));
    CHECK(along[2 * kColumns - 1] < 4.9);             // along an edge and across
    CHECK(along[3] == Approx(std::hypot(0.1, 1.0)));  // across the diagonal of the first two triangles
    CHECK(std::isinf(along[2 * kColumns]));
}

TEST_CASE("each arm of a star is a limb with its tip at the end; what is round has none") {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const Mesh mesh = limbed(seed);
        const std::vector<Limb> limbs = find_limbs(mesh, {}).limbs;
        REQUIRE(limbs.size() == kArms);
        for (int arm = 0; arm < kArms; ++arm) {
            const Vector3d end = tip_of_arm(mesh, arm);
            const auto found = std::find_if(limbs.begin(), limbs.end(), [&](const Limb& limb) {
                return (mesh.V.row(limb.tip).transpose() - end).norm() < 0.12;
            });
            REQUIRE(found != limbs.end());
            // As long as the arm is beyond the valleys, more or less.
            CHECK(found->length > 0.4 * (end.norm() - 0.33));
            CHECK(found->length < 1.6 * (end.norm() - 0.33));
            // The middle runs inside the arm.
            const Vector3d middle = found->middle(0.5 * found->length).transpose();
            CHECK((middle - middle.dot(end.normalized()) * end.normalized()).norm() < 0.08);
            CHECK(found->direction(0.5 * found->length).dot(end.normalized()) < -0.95);
        }
    }
    CHECK(find_limbs(ellipsoid({1, 1, 1}, {.triangles = 3000}), {}).limbs.empty());
    CHECK(find_limbs(ellipsoid({1, 0.8, 0.7}, {.triangles = 3000}), {}).limbs.empty());
    CHECK(find_limbs(head({.parameters = {}, .crop = HeadCrop::Closed, .shape = {.triangles = 4000}}), {})
              .limbs.empty());
}

TEST_CASE("an arm that is cut off has no tip") {
    const Mesh whole = limbed(1);
    Mesh cut = whole;
    int kept = 0;
    for (int f = 0; f < whole.triangle_count(); ++f) {
        if (std::max({whole.V(whole.F(f, 0), 0), whole.V(whole.F(f, 1), 0), whole.V(whole.F(f, 2), 0)}) <
            0.75)
            cut.F.row(kept++) = whole.F.row(f);
    }
    cut.F.conservativeResize(kept, 3);
    const Mesh open = admit_mesh(cut).mesh;
    const std::vector<Limb> limbs = find_limbs(open, boundary_loops(open)).limbs;
    CHECK(limbs.size() == kArms - 1);
    for (const Limb& limb : limbs) CHECK(open.V(limb.tip, 0) < 0.7);
}

TEST_CASE("limbs find their partners though they point elsewhere, and a contradiction is left out") {
    const Mesh a = limbed(1);
    Mesh b = limbed(2);
    const Mesh straight = b;
    b.V = swung(b.V, kSideways, kUp);
    const Limbs of_a = find_limbs(a, {}), of_b = find_limbs(b, {});
    const std::vector<LimbMatch> matches = match_limbs(a.V, of_a, b.V, of_b, bounding_box_diagonal(b.V));
    REQUIRE(matches.size() == kArms);
    for (const LimbMatch match : matches) {
        const int tip_a = of_a.limbs[static_cast<std::size_t>(match.source)].tip,
                  tip_b = of_b.limbs[static_cast<std::size_t>(match.target)].tip;
        CHECK((a.V.row(tip_a) - straight.V.row(tip_b)).norm() < 0.25);  // one arm
    }
    // A limb that is three times as far from all others as its partner cannot be the right one.
    Limbs torn = of_a;
    Limb& far = torn.limbs[2];
    far.from_tip *= 3.0;
    for (Limb& limb : torn.limbs) limb.from_tip[far.tip] = far.from_tip[limb.tip];
    const std::vector<LimbMatch> left = match_limbs(a.V, of_a, a.V, torn, bounding_box_diagonal(a.V));
    REQUIRE(left.size() == kArms - 1);
    for (const LimbMatch match : left) {
        CHECK(match.source == match.target);
        CHECK(match.source != 2);
    }
}

TEST_CASE("a limb's places on its bent self are those of its vertices") {
    const Mesh a = limbed(1);
    const Mesh b{swung(a.V, kSideways, kUp), a.F};
    const Limbs of_a = find_limbs(a, {}), of_b = find_limbs(b, {});
    int compared = 0;
    for (const LimbMatch match : match_limbs(a.V, of_a, b.V, of_b, bounding_box_diagonal(b.V))) {
        for (const LimbPlace& place : limb_places(a, of_a.limbs[static_cast<std::size_t>(match.source)],
                                                  of_b.limbs[static_cast<std::size_t>(match.target)])) {
            if (place.weight < 1.0) continue;
            ++compared;
            CHECK((place.place - b.V.row(place.vertex)).norm() < 0.04 * bounding_box_diagonal(b.V));
        }
    }
    CHECK(compared > 100);
}

TEST_CASE("arms that were swung are found by the dense alignment; those that hardly were lose nothing") {
    const Mesh source = limbed(1);
    MorphOptions without;
    without.nonrigid.limbs = 0.0;
    for (const double far : {0.5, 1.6}) {
        std::array<double, kArms> sideways = kSideways, up = kUp;
        for (double& angle : sideways) angle *= far;
        for (double& angle : up) angle *= far;
        Mesh target = limbed(2);
        target.V = swung(target.V, sideways, up);
        const Points truth = swung(source.V, sideways, up);
        const Morph plain = morph(admit_mesh(source), admit_mesh(target), without),
                    with = morph(admit_mesh(source), admit_mesh(target));
        const double before = mean_off(plain.correspondence(), truth),
                     after = mean_off(with.correspondence(), truth);
        INFO("swung " << far << ": before " << before << " %, after " << after << " %");
        CHECK(after < (far < 1.0 ? 1.1 : 0.65) * before);
        CHECK(after < (far < 1.0 ? 0.6 : 1.8));
        const AlignmentReport& report = with.report().alignment;
        CHECK(report.limbs_source == kArms);
        CHECK(report.limbs_target == kArms);
        CHECK(report.limb_matches.size() == kArms);
        CHECK(plain.report().alignment.limb_matches.empty());
        for (const auto& [a, b] : report.limb_matches) {
            CHECK((with.correspondence().row(a) - target.V.row(b)).norm() <
                  0.05 * bounding_box_diagonal(target.V));
        }
        for (const MapReport& map : with.report().maps) CHECK(map.flipped == 0);
    }
}
