#include "morph/shading.h"

#include <algorithm>

#include "morph/mesh/geometry.h"
#include "morph/morph.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

InputMesh sphere(int triangles, std::uint64_t seed) {
    return admit_mesh(ellipsoid({1, 1, 1}, {.triangles = triangles, .seed = seed}), "sphere");
}

double mean_on_sphere(const Points& V, const Points& normals) {
    return (normals.rowwise().normalized() - V.rowwise().normalized()).rowwise().norm().mean();
}

/// The largest sine between a unit sphere's normals and these.
double worst_on_sphere(const Points& V, const Points& normals) {
    double worst = 0.0;
    for (Eigen::Index v = 0; v < V.rows(); ++v) {
        const Eigen::RowVector3d n = normals.row(v).normalized(), exact = V.row(v).normalized();
        worst = std::max(worst, (n - exact).norm());
    }
    return worst;
}

Mesh cube() {
    Mesh mesh;
    mesh.V.resize(8, 3);
    for (int v = 0; v < 8; ++v) mesh.V.row(v) << (v & 1), (v >> 1 & 1), (v >> 2);
    mesh.F.resize(12, 3);
    mesh.F << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3,
        5, 3, 7, 5;
    return mesh;
}

}  // namespace

TEST_CASE("shaded by corrected normals, both ends of a morph look like their own meshes") {
    const InputMesh a = sphere(500, 1), b = sphere(500, 2);
    const Morph result = morph(a, b, {.lift = false});
    const Points at_a = area_weighted_normals(result.frame(0), result.triangles()),
                 at_b = area_weighted_normals(result.frame(1), result.triangles());
    // Flat facets: the merged mesh's own normals are those of the facets, up to half an edge off.
    CHECK(worst_on_sphere(result.frame(0), at_a) > 0.05);
    CHECK(worst_on_sphere(result.frame(1), at_b) > 0.05);
    // Interpolated vertex normals of a sphere are nearly its own.
    CHECK(worst_on_sphere(result.frame(0), at_a + result.shading(0)) < 0.02);
    CHECK(worst_on_sphere(result.frame(1), at_b + result.shading(1)) < 0.02);

    // At the vertices of the source they are its vertex normals.
    const Points own = vertex_normals(a.mesh);
    for (int v = 0; v < a.mesh.vertex_count(); ++v) {
        Eigen::Index merged = 0;
        REQUIRE((result.frame(0).rowwise() - a.mesh.V.row(v)).rowwise().norm().minCoeff(&merged) == 0.0);
        const Eigen::RowVector3d shaded = (at_a + result.shading(0)).row(merged).normalized();
        CHECK((shaded - own.row(v)).norm() < 1e-12);
    }
}

TEST_CASE("corrected normals are nearer to the surface in between, too") {
    const Morph result = morph(sphere(500, 1), sphere(300, 2), {.lift = false});
    for (const double alpha : {0.25, 0.5, 0.75}) {
        const Points V = result.frame(alpha), plain = area_weighted_normals(V, result.triangles());
        const double before = mean_on_sphere(V, plain),
                     after = mean_on_sphere(V, plain + result.shading(alpha));
        INFO(alpha << ": " << before << " " << after);
        CHECK(after < 0.2 * before);
    }
}

TEST_CASE("the edges of a solid are to be seen") {
    const Shape solid{cube(), Points::Zero(8, 3), 8};
    const std::vector<Site> sites{{{0, -1, -1}, {1, 0, 0}, 1}, {{1, 2, 3}, {0.2, 0.5, 0.3}, 3}};
    CHECK(shading_correction(solid, sites, solid.mesh.V.topRows(2), Triangles(0, 3)).isZero(0.0));
}
