#include "morph/features/curvature.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "morph/mesh/admit.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"
#include "tests/morph/features/surfaces.h"
#include "tests/morph/mesh/shapes.h"

using namespace automorph;
using namespace automorph::testing;

namespace {

Curvature curvature(const Mesh& mesh) {
    return automorph::curvature(mesh, HalfEdgeTable(mesh.F, mesh.vertex_count()));
}

/// Curvatures of a smooth surface at a vertex, not free of scale.
struct Exact {
    double gaussian, mean;
};
using Field = std::function<Exact(const Eigen::Vector3d&)>;

/// Largest deviations from the smooth surface over all vertices where curvature is defined.
Exact errors(const Mesh& mesh, const Field& exact) {
    const Curvature found = curvature(mesh);
    const double area = triangle_areas(mesh).sum();
    Exact worst{0, 0};
    int compared = 0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        if (!found[v]) continue;
        ++compared;
        const Exact here = exact(mesh.V.row(v));
        worst.gaussian = std::max(worst.gaussian, std::abs(found.gaussian[v] / area - here.gaussian));
        worst.mean = std::max(worst.mean, std::abs(found.mean[v] / std::sqrt(area) - here.mean));
    }
    CHECK(compared > mesh.vertex_count() / 2);
    return worst;
}

/// Halving the edges divides the errors by about four.
void check_second_order(const std::function<Mesh(int)>& mesh, const Field& exact, double scale) {
    const Exact coarse = errors(mesh(24), exact), fine = errors(mesh(48), exact);
    INFO("K " << coarse.gaussian << " -> " << fine.gaussian << ", H " << coarse.mean << " -> " << fine.mean);
    CHECK(fine.gaussian < 0.02 * scale * scale);
    CHECK(fine.mean < 0.02 * scale);
    CHECK(fine.gaussian < 0.35 * coarse.gaussian + 1e-9);
    CHECK(fine.mean < 0.35 * coarse.mean + 1e-9);
}

}  // namespace

TEST_CASE("curvatures of a cylinder converge: 0 and 1 / (2 r)") {
    check_second_order([](int n) { return cylinder(2.0, n); },
                       [](const auto&) {
                           return Exact{0.0, 0.25};
                       },
                       1.0);
}

TEST_CASE("curvatures of a torus converge at every vertex") {
    const Field exact = [](const Eigen::Vector3d& p) {
        const double cosine = p.head<2>().norm() - 3.0;  // of the angle round the tube of radius 1
        return Exact{cosine / (3.0 + cosine), 0.5 * (1.0 + cosine / (3.0 + cosine))};
    };
    check_second_order([](int n) { return ring(3.0, 1.0, 3 * n, n); }, exact, 1.0);
}

TEST_CASE("curvatures of a saddle converge at every inner vertex") {
    const Field exact = [](const Eigen::Vector3d& p) {
        const double g = 1.0 + p.x() * p.x() + p.y() * p.y();  // z = x y
        return Exact{-1.0 / (g * g), p.x() * p.y() / std::pow(g, 1.5)};
    };
    check_second_order([](int n) { return graph(n, [](double x, double y) { return x * y; }); }, exact, 1.0);
}

TEST_CASE("curvatures of a sphere converge where the valence is six") {
    // An octahedron's six corners keep valence 4, where the scheme gives 3/4 / cos^2(45 degrees) = 1.5.
    const auto error = [](int levels) {
        const Mesh mesh = sphere(levels);
        const Curvature found = curvature(mesh);
        const double area = triangle_areas(mesh).sum();
        double worst = 0.0;
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            CHECK(found.mean[v] > 0.0);  // convex, facing outwards
            const bool corner = mesh.V.row(v).cwiseAbs().maxCoeff() == 1.0;
            if (corner) CHECK(found.gaussian[v] / area == Approx(1.5).epsilon(0.05));
            // Subdivision leaves triangles of two sizes along the octahedron's edges.
            const bool crease = mesh.V.row(v).cwiseAbs().minCoeff() < 1e-12;
            if (!crease) worst = std::max(worst, std::abs(found.gaussian[v] / area - 1.0));
        }
        return worst;
    };
    const double coarse = error(4), fine = error(5);
    INFO(coarse << " -> " << fine);
    CHECK(fine < 0.05);
    CHECK(fine < coarse);
}

TEST_CASE("total curvature is 2 pi chi on any closed mesh") {
    const auto total = [](const Mesh& mesh) {
        const Curvature found = curvature(mesh);
        return found.gaussian.dot(vertex_areas(mesh)) / triangle_areas(mesh).sum();
    };
    CHECK(total(sphere(3)) == Approx(4 * std::numbers::pi).epsilon(1e-12));
    CHECK(total(star({}, {.triangles = 2000})) == Approx(4 * std::numbers::pi).epsilon(1e-10));
    CHECK(total(admit(cube(), "cube").mesh) == Approx(4 * std::numbers::pi).epsilon(1e-12));
    CHECK(std::abs(total(ring(3.0, 1.0, 30, 10))) < 1e-11);
}

TEST_CASE("curvatures stay the same under motion and scale; mean curvature turns with the orientation") {
    const Mesh mesh = star({}, {.triangles = 2000});
    Mesh moved = mesh, inside_out = mesh;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    moved.V = (37.0 * mesh.V * turn.transpose()).rowwise() + Eigen::RowVector3d(5, 6, 7);
    inside_out.F.col(1).swap(inside_out.F.col(2));
    const Curvature a = curvature(mesh), b = curvature(moved), c = curvature(inside_out);
    const double gaussian = 1e-9 * a.gaussian.cwiseAbs().maxCoeff(),
                 mean = 1e-9 * a.mean.cwiseAbs().maxCoeff();
    CHECK((a.gaussian - b.gaussian).cwiseAbs().maxCoeff() < gaussian);
    CHECK((a.mean - b.mean).cwiseAbs().maxCoeff() < mean);
    CHECK((a.gaussian - c.gaussian).cwiseAbs().maxCoeff() < gaussian);
    CHECK((a.mean + c.mean).cwiseAbs().maxCoeff() < mean);
}

TEST_CASE("curvature is not defined on borders and without area, and 0 there") {
    Mesh mesh = grid(4, [](int i, int j) { return i == 0 && j == 0; });
    mesh.V(12, 2) = 0.5;
    const Curvature found = curvature(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const int i = v % 5, j = v / 5;
        const bool inner = i > 0 && i < 4 && j > 0 && j < 4 && !(i == 1 && j == 1);
        CHECK(found[v] == inner);
        if (!inner) CHECK((found.gaussian[v] == 0.0 && found.mean[v] == 0.0));
    }
    CHECK(found.gaussian[12] > 0.0);
    mesh.V.setZero();
    const Curvature none = curvature(mesh);
    for (int v = 0; v < mesh.vertex_count(); ++v) CHECK_FALSE(none[v]);
}

TEST_CASE("smoothing keeps constants and totals, and widens a peak to the given length") {
    const Mesh mesh = sphere(5);
    const double area = triangle_areas(mesh).sum();
    const Eigen::VectorXd areas = vertex_areas(mesh);
    Curvature peak = curvature(mesh);
    const double total = peak.gaussian.dot(areas);
    CHECK(smoothed(peak, mesh, 0.1).gaussian.dot(areas) == Approx(total).epsilon(1e-9));
    peak.mean.setConstant(3.0);
    peak.gaussian.setZero();
    peak.gaussian[4] = 1.0 / areas[4];  // the vertex at +z
    const Curvature wide = smoothed(peak, mesh, 0.05);
    CHECK((wide.mean.array() - 3.0).abs().maxCoeff() < 1e-9);
    CHECK(wide.gaussian.minCoeff() >= 0.0);
    double variance = 0.0;
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double distance = std::acos(std::min(1.0, mesh.V(v, 2)));
        variance += 0.5 * areas[v] * wide.gaussian[v] * distance * distance;  // half of it along each line
    }
    CHECK(std::sqrt(variance) == Approx(0.05 * std::sqrt(area)).epsilon(0.05));
}
