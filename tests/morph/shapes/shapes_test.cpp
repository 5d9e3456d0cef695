#include "morph/shapes/shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <vector>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/star.h"
#include "tests/catch.h"
#include "tests/morph/shapes/triangle_quality.h"

using namespace automorph;

namespace {

using std::numbers::pi;
const Eigen::Vector3d kAxes(1.0, 0.75, 0.55);

ShapeOptions tessellation(int triangles, std::uint64_t seed = 1) {
    ShapeOptions options;
    options.triangles = triangles;
    options.seed = seed;
    return options;
}

double distance_to_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
    const Eigen::Vector3d n = (b - a).cross(c - a);
    const auto inside = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
        return n.dot((y - x).cross(p - x)) >= 0.0;
    };
    if (inside(a, b) && inside(b, c) && inside(c, a)) return std::abs(n.normalized().dot(p - a));
    const auto to_edge = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& y) {
        const double t = std::clamp((p - x).dot(y - x) / (y - x).squaredNorm(), 0.0, 1.0);
        return (p - x - t * (y - x)).norm();
    };
    return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

/// Largest distance of a vertex of one mesh from the triangles of the other, and of an edge's middle
/// likewise.
double one_sided_hausdorff(const Mesh& from, const Mesh& to) {
    double largest = 0.0;
    for (int v = 0; v < from.vertex_count(); ++v) {
        double least = 1e300;
        for (int f = 0; f < to.triangle_count(); ++f) {
            least = std::min(least, distance_to_triangle(from.V.row(v), to.V.row(to.F(f, 0)),
                                                         to.V.row(to.F(f, 1)), to.V.row(to.F(f, 2))));
        }
        largest = std::max(largest, least);
    }
    return largest;
}

/// Edge length of equilateral triangles of this mesh's number and area.
double mean_edge(const Mesh& mesh) {
    return std::sqrt(4.0 * triangle_areas(mesh).sum() / (std::sqrt(3.0) * mesh.triangle_count()));
}

/// Directions (angles in the xy-plane) of the vertices that are farther out than all their neighbours.
std::vector<int> local_maxima_of_radius(const Mesh& mesh) {
    std::vector<bool> is_maximum(static_cast<std::size_t>(mesh.vertex_count()), true);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.F(f, k), b = mesh.F(f, (k + 1) % 3);
            const bool a_is_farther = mesh.V.row(a).norm() > mesh.V.row(b).norm();
            is_maximum[static_cast<std::size_t>(a_is_farther ? b : a)] = false;
        }
    }
    std::vector<int> maxima;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (is_maximum[static_cast<std::size_t>(v)]) maxima.push_back(v);
    }
    return maxima;
}

void check_sphere_topology(const Mesh& mesh) {
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    CHECK(euler_characteristic(topology) == 2);
    CHECK(boundary_loops(mesh, topology).empty());
    CHECK(mesh.F.minCoeff() == 0);
    CHECK(mesh.F.maxCoeff() == mesh.vertex_count() - 1);
    CHECK(signed_volume(mesh) > 0.0);
}

}  // namespace

TEST_CASE("Shapes are closed manifolds of genus 0 with the number of triangles asked for") {
    for (const int triangles : {100, 501, 2000, 8000}) {
        CAPTURE(triangles);
        const Mesh e = ellipsoid(kAxes, tessellation(triangles)), s = star({}, tessellation(triangles));
        CHECK(e.triangle_count() == 2 * (triangles / 2));
        CHECK(s.triangle_count() == 2 * (triangles / 2));
        check_sphere_topology(e);
        check_sphere_topology(s);
    }
}

TEST_CASE("Vertices of an ellipsoid lie on it") {
    for (const Eigen::Vector3d& axes : {kAxes, Eigen::Vector3d(5, 1, 0.5), Eigen::Vector3d(1e-4, 3e-4, 2e-4),
                                        Eigen::Vector3d(1e7, 2e7, 1e7)}) {
        const Mesh mesh = ellipsoid(axes, tessellation(2000));
        const Eigen::ArrayXd radius =
            (mesh.V.array().rowwise() / axes.transpose().array()).matrix().rowwise().norm();
        CHECK((radius - 1.0).abs().maxCoeff() < 1e-12);
    }
}

TEST_CASE("Volume and area converge quadratically to those of the ellipsoid") {
    const double volume = 4.0 / 3.0 * pi * kAxes.prod();
    const double coarse = volume - signed_volume(ellipsoid(kAxes, tessellation(1000)));
    const double fine = volume - signed_volume(ellipsoid(kAxes, tessellation(16000)));
    CHECK(coarse > 0.0);
    CHECK(fine < 2e-3 * volume);
    CHECK(coarse / fine == Approx(16.0).epsilon(0.1));

    const Mesh ball = ellipsoid({2, 2, 2}, tessellation(16000));
    CHECK(triangle_areas(ball).sum() == Approx(16.0 * pi).epsilon(1e-3));
}

TEST_CASE("Triangles are even", "[sweep]") {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        StarParameters six;
        six.arms = 6;
        six.inner = 0.5;
        const Mesh meshes[] = {ellipsoid(kAxes, tessellation(8000, seed)), star({}, tessellation(8000, seed)),
                               star(six, tessellation(8000, seed)),
                               ellipsoid({5, 1, 1}, tessellation(8000, seed))};
        for (const Mesh& mesh : meshes) {
            CAPTURE(seed);
            const TriangleQuality quality = triangle_quality(mesh);
            CHECK(quality.least_angle > 28.0);
            CHECK(quality.mean_least_angle > 50.0);
            CHECK(quality.largest_angle < 115.0);
            CHECK(quality.least_area > 0.4);
            CHECK(quality.largest_area < 2.1);
        }
    }
}

TEST_CASE("No vertex is a pole and no pattern repeats") {
    // In a subdivided or latitude-longitude mesh nearly all vertices have valence 6; poles have many.
    const Mesh mesh = ellipsoid(kAxes, tessellation(8000));
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    int most = 0, regular = 0;
    for (const auto v : topology.vertices()) {
        const int valence = static_cast<int>(topology.valence(v));
        most = std::max(most, valence);
        regular += valence == 6;
    }
    CHECK(most <= 10);
    CHECK(regular < 0.8 * mesh.vertex_count());
}

TEST_CASE("A star has its tips, valleys and thickness where they were asked for") {
    for (const int arms : {3, 5, 6, 12}) {
        for (const double inner : {0.2, 0.35, 0.5, 0.8}) {
            CAPTURE(arms, inner);
            StarParameters parameters;
            parameters.arms = arms;
            parameters.outer = 2.0;
            parameters.inner = 2.0 * inner;
            parameters.depth = 0.5;
            const ImplicitSurface surface = star_surface(parameters);
            for (int k = 0; k < arms; ++k) {
                const double tip = 2.0 * pi * k / arms, valley = 2.0 * pi * (k + 0.5) / arms;
                const Eigen::Vector3d to_tip(std::cos(tip), std::sin(tip), 0.0);
                const Eigen::Vector3d to_valley(std::cos(valley), std::sin(valley), 0.0);
                CHECK(surface(2.0 * to_tip).value == Approx(0.0).margin(1e-12));
                CHECK(surface(2.0 * inner * to_valley).value == Approx(0.0).margin(1e-12));
                CHECK(surface(2.0 * to_tip).gradient.normalized().dot(to_tip) == Approx(1.0));
                CHECK(surface(2.0 * inner * to_valley).gradient.normalized().dot(to_valley) == Approx(1.0));
            }
            CHECK(surface({0, 0, 0.5}).value == Approx(0.0).margin(1e-12));
            CHECK(surface({0, 0, -0.5}).value == Approx(0.0).margin(1e-12));
        }
    }
}

TEST_CASE("A meshed star has as many tips as arms", "[sweep]") {
    for (const int arms : {3, 5, 6, 8}) {
        CAPTURE(arms);
        StarParameters parameters;
        parameters.arms = arms;
        const Mesh mesh = star(parameters, tessellation(8000));
        const std::vector<int> tips = local_maxima_of_radius(mesh);
        CHECK(static_cast<int>(tips.size()) == arms);
        for (const int v : tips) {
            CHECK(mesh.V.row(v).norm() == Approx(parameters.outer).epsilon(0.01));
            CHECK(std::abs(mesh.V(v, 2)) < 0.05);
        }
    }
}

TEST_CASE("A star's vertices lie on its surface") {
    const StarParameters parameters;
    const ImplicitSurface surface = star_surface(parameters);
    const Mesh mesh = star(parameters);
    double farthest = 0.0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const FieldSample sample = surface(mesh.V.row(v).transpose());
        farthest = std::max(farthest, std::abs(sample.value) / sample.gradient.norm());
    }
    CHECK(farthest < 1e-13);
}

TEST_CASE("The star's field is symmetric and its gradient is that of its values") {
    StarParameters parameters;
    const ImplicitSurface surface = star_surface(parameters);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0 * pi / 5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    for (int k = 0; k < 50; ++k) {
        const Eigen::Vector3d p =
            Eigen::Vector3d(std::sin(1.0 + 3 * k), std::sin(2.0 + 7 * k), 0.4 * std::sin(5.0 * k));
        const FieldSample sample = surface(p);
        CHECK(surface(turn * p).value == Approx(sample.value).epsilon(1e-12));
        CHECK(surface(Eigen::Vector3d(p.x(), -p.y(), -p.z())).value == Approx(sample.value).epsilon(1e-12));
        for (int axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3d step = 1e-5 * Eigen::Vector3d::Unit(axis);
            const double difference = (surface(p + step).value - surface(p - step).value) / 2e-5;
            CHECK(sample.gradient[axis] == Approx(difference).margin(1e-6));
        }
    }
}

TEST_CASE("The same seed gives the same bits") {
    for (const int triangles : {300, 4000}) {
        const Mesh a = star({}, tessellation(triangles, 11)), b = star({}, tessellation(triangles, 11));
        REQUIRE(a.V.rows() == b.V.rows());
        CHECK(a.F == b.F);
        CHECK(std::memcmp(a.V.data(), b.V.data(), static_cast<std::size_t>(a.V.size()) * sizeof(double)) ==
              0);
    }
}

TEST_CASE("An opening cuts the ellipsoid off in a plane") {
    const Mesh mesh = ellipsoid({1.0, 0.8, 0.5}, {.triangles = 3000, .seed = 2}, 0.25);
    const auto loops = boundary_loops(mesh, connectivity(mesh.F, mesh.vertex_count()));
    REQUIRE(loops.size() == 1);
    for (const int v : loops[0]) CHECK(mesh.V(v, 2) == Approx(-0.25).margin(1e-9));
    CHECK(mesh.V.col(2).minCoeff() > -0.25 - 1e-9);
    CHECK_THROWS_AS(ellipsoid({1, 1, 1}, {}, 1.0), InvalidMesh);
}

TEST_CASE("Another seed gives another tessellation of the same surface", "[sweep]") {
    for (const bool is_star : {false, true}) {
        const auto make = [&](std::uint64_t seed) {
            return is_star ? star({}, tessellation(3000, seed)) : ellipsoid(kAxes, tessellation(3000, seed));
        };
        const Mesh a = make(1), b = make(2);
        // Nearest vertices of independent sets of this density are 0.45 edges apart on average.
        double sum = 0.0;
        for (int v = 0; v < a.vertex_count(); ++v) {
            sum += std::sqrt((b.V.rowwise() - a.V.row(v)).rowwise().squaredNorm().minCoeff());
        }
        const double edge = mean_edge(a);
        CHECK(sum / a.vertex_count() > 0.3 * edge);
        CHECK(std::max(one_sided_hausdorff(a, b), one_sided_hausdorff(b, a)) < 0.2 * edge);
        CHECK(signed_volume(a) == Approx(signed_volume(b)).epsilon(2e-3));
    }
}

TEST_CASE("The pose moves the finished mesh") {
    ShapeOptions options = tessellation(1000);
    const Mesh before = star({}, options);
    options.scale = 3.0;
    options.rotation = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    options.translation = Eigen::Vector3d(4, 5, 6);
    const Mesh after = star({}, options);
    CHECK(before.F == after.F);
    for (int v = 0; v < before.vertex_count(); ++v) {
        const Eigen::Vector3d expected =
            3.0 * options.rotation * before.V.row(v).transpose() + options.translation;
        CHECK((after.V.row(v).transpose() - expected).norm() < 1e-13);
    }
}

TEST_CASE("Shapes that cannot be are refused") {
    CHECK_THROWS_AS(ellipsoid({1, 0, 1}), InvalidMesh);
    CHECK_THROWS_AS(ellipsoid({1, -1, 1}), InvalidMesh);
    CHECK_THROWS_AS(ellipsoid({1, std::nan(""), 1}), InvalidMesh);
    StarParameters parameters;
    SECTION("two arms") {
        parameters.arms = 2;
    }
    SECTION("too many arms") {
        parameters.arms = 13;
    }
    SECTION("valleys outside the tips") {
        parameters.inner = 1.1;
    }
    SECTION("valleys at the centre") {
        parameters.inner = 0.0;
    }
    SECTION("no thickness") {
        parameters.depth = 0.0;
    }
    SECTION("no radius") {
        parameters.outer = std::nan("");
    }
    CHECK_THROWS_AS(star(parameters), InvalidMesh);
}
