#include "morph/alignment/closest_point.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>

#include "morph/alignment/places.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/random.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;
using Eigen::Vector3d;

namespace {

/// By sampling: the closest of many points of a triangle, refined around the best.
double sampled_distance(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    double least = std::numeric_limits<double>::infinity(), u0 = 0.5, v0 = 0.5;
    for (double step = 0.05; step > 1e-6; step *= 0.25) {
        double best_u = u0, best_v = v0;
        for (int i = -12; i <= 12; ++i) {
            for (int j = -12; j <= 12; ++j) {
                const double u = std::clamp(u0 + i * step, 0.0, 1.0),
                             v = std::clamp(v0 + j * step, 0.0, 1.0 - u);
                const double d = (a + u * (b - a) + v * (c - a) - p).norm();
                if (d < least) {
                    least = d;
                    best_u = u;
                    best_v = v;
                }
            }
        }
        u0 = best_u;
        v0 = best_v;
    }
    return least;
}

Vector3d normal(const Mesh& mesh, int f) {
    const Vector3d a = mesh.V.row(mesh.F(f, 0)), b = mesh.V.row(mesh.F(f, 1)), c = mesh.V.row(mesh.F(f, 2));
    return (b - a).cross(c - a).normalized();
}

}  // namespace

TEST_CASE("the closest point is as close as that of an exhaustive search, far from the origin too") {
    Mesh mesh = ellipsoid({1.0, 0.6, 0.3}, {.triangles = 120});
    const Vector3d shift(4000.0, -3000.0, 500.0);
    mesh.V.rowwise() += shift.transpose();
    const ClosestPoints closest(mesh);
    Random random(3);
    for (int i = 0; i < 60; ++i) {
        const Vector3d p = 1.5 * random.in_ball<3>() + shift;
        const SurfacePlace place = closest.query(p, Vector3d::Zero(), -2.0);
        REQUIRE(place.found());
        CHECK(place.weights.minCoeff() >= 0.0);
        CHECK(place.weights.sum() == Approx(1.0));
        double least = std::numeric_limits<double>::infinity();
        for (int f = 0; f < mesh.triangle_count(); ++f) {
            least = std::min(least, sampled_distance(p, mesh.V.row(mesh.F(f, 0)), mesh.V.row(mesh.F(f, 1)),
                                                     mesh.V.row(mesh.F(f, 2))));
        }
        CHECK((place.in(mesh.V).transpose() - p).norm() == Approx(least).margin(1e-6));
    }
}

TEST_CASE("a normal keeps the two sides of a thin sheet apart") {
    const Mesh mesh = ellipsoid({1.0, 1.0, 0.2}, {.triangles = 1000});
    const ClosestPoints closest(mesh);
    Random random(5);
    for (int i = 0; i < 40; ++i) {
        Vector3d p = 0.8 * random.in_ball<3>();
        p.z() = 0.3;  // above the sheet
        for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(0, 0, -1)}) {
            const SurfacePlace place = closest.query(p, direction, 0.3);
            REQUIRE(place.found());
            const Vector3d a = mesh.V.row(place.corners[0]), b = mesh.V.row(place.corners[1]),
                           c = mesh.V.row(place.corners[2]);
            CHECK((b - a).cross(c - a).normalized().dot(direction) > 0.3);
            double least = std::numeric_limits<double>::infinity();
            for (int f = 0; f < mesh.triangle_count(); ++f) {
                if (normal(mesh, f).dot(direction) > 0.3)
                    least =
                        std::min(least, sampled_distance(p, mesh.V.row(mesh.F(f, 0)),
                                                         mesh.V.row(mesh.F(f, 1)), mesh.V.row(mesh.F(f, 2))));
            }
            CHECK((place.in(mesh.V).transpose() - p).norm() == Approx(least).margin(1e-5));
        }
    }
}

TEST_CASE("closest points and nearest facets are those of an exhaustive search by doubles") {
    Mesh mesh = ellipsoid({1.0, 0.9, 0.15}, {.triangles = 2000});
    Random random(11);
    for (Eigen::Index v = 0; v < mesh.V.rows(); ++v)  // creased: neighbours disagree
        mesh.V.row(v) += 0.03 * random.in_ball<3>().transpose();
    const double diagonal = bounding_box_diagonal(mesh.V);
    const ClosestPoints closest(mesh);
    int not_found = 0;
    for (int i = 0; i < 500; ++i) {
        const Vector3d p = 1.2 * random.in_ball<3>(), n = random.in_ball<3>().normalized();
        const double least_agreement = i % 2 == 0 ? 0.3 : 0.9995;
        const SurfacePlace place = closest.query(p, n, least_agreement);
        const SurfacePlace facet = closest.nearest_facet(p, n, 0.03);
        bool agrees = false;
        double nearest = std::numeric_limits<double>::infinity();
        std::array<int, 3> corners{};
        for (int f = 0; f < mesh.triangle_count(); ++f) {
            const Vector3d a = mesh.V.row(mesh.F(f, 0)), b = mesh.V.row(mesh.F(f, 1)),
                           c = mesh.V.row(mesh.F(f, 2)), n_f = normal(mesh, f);
            const double distance = ((a + b + c) / 3.0 - p).squaredNorm() / std::pow(0.03 * diagonal, 2) +
                                    (n_f - n).squaredNorm();
            if (distance < nearest) {
                nearest = distance;
                corners = {mesh.F(f, 0), mesh.F(f, 1), mesh.F(f, 2)};
            }
            if (n_f.dot(n) <= least_agreement) continue;
            agrees = true;
            // No point of an agreeing triangle is closer: its corners, edges and inside by sampling.
            for (int u = 0; u <= 4; ++u) {
                for (int v = 0; u + v <= 4; ++v) {
                    const Vector3d q = a + 0.25 * u * (b - a) + 0.25 * v * (c - a);
                    if (place.found() && (q - p).norm() < (place.in(mesh.V).transpose() - p).norm() - 1e-12)
                        FAIL("triangle " << f << " is closer");
                }
            }
        }
        CHECK(place.found() == agrees);
        CHECK(facet.corners == corners);
        not_found += !agrees;
    }
    CHECK(not_found > 20);  // the other case is tested, too
    CHECK(not_found < 250);
}

TEST_CASE("where no normal agrees there is no closest point, but a place all the same") {
    Mesh sheet{Points(4, 3), Triangles(2, 3)};
    sheet.V << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
    sheet.F << 0, 1, 2, 0, 2, 3;
    CHECK(normal(sheet, 0).z() == 1.0);
    Points point(1, 3), down(1, 3);
    point << 0.9, 0.1, 0.1;
    down << 0, 0, -1;
    CHECK_FALSE(ClosestPoints(sheet).query(point.row(0), down.row(0), 0.3).found());
    const std::vector<SurfacePlace> places = places_on(sheet, point, down);
    REQUIRE(places[0].found());
    CHECK((places[0].in(sheet.V) - sheet.V(std::vector<int>{0, 1, 2}, Eigen::all).colwise().mean()).norm() <
          1e-12);
}
