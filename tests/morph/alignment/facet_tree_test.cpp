#include "morph/alignment/facet_tree.h"

#include <cmath>
#include <limits>
#include <set>

#include "tests/catch.h"

using namespace automorph;
using Eigen::Vector3d;

namespace {

/// A terrain of 2 n^2 triangles on the unit square that faces upwards, steep nowhere.
Mesh terrain(int n) {
    Mesh mesh{Points((n + 1) * (n + 1), 3), Triangles(2 * n * n, 3)};
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
            mesh.V.row(i * (n + 1) + j) << x, y, 0.02 * std::sin(9.0 * x) * std::cos(7.0 * y);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j, b = a + n + 1;
            mesh.F.row(2 * (i * n + j)) << a, b, b + 1;
            mesh.F.row(2 * (i * n + j) + 1) << a, b + 1, a + 1;
        }
    }
    return mesh;
}

Points normals(const Mesh& mesh) {
    Points n(mesh.triangle_count(), 3);
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        const Vector3d a = mesh.V.row(mesh.F(f, 0)), b = mesh.V.row(mesh.F(f, 1)),
                       c = mesh.V.row(mesh.F(f, 2));
        n.row(f) = (b - a).cross(c - a).normalized();
    }
    return n;
}

}  // namespace

TEST_CASE("without a limit every triangle is visited once") {
    const Mesh mesh = terrain(7);
    const FacetTree tree(mesh, normals(mesh));
    std::multiset<int> visited;
    const double limit = 0.0;
    tree.search([](const FacetTree::Bounds&) { return 0.0; }, limit, [&](int f) { visited.insert(f); });
    CHECK(visited.size() == 98);
    CHECK(std::set<int>(visited.begin(), visited.end()).size() == 98);
    FacetTree({Points(0, 3), Triangles(0, 3)}, Points(0, 3))
        .search([](const FacetTree::Bounds&) { return 0.0; }, limit, [](int) { FAIL("there is none"); });
}

TEST_CASE("a search looks at few triangles, also where most face the wrong way or none the right one") {
    const Mesh mesh = terrain(100);
    const Points n = normals(mesh);
    const FacetTree tree(mesh, n);
    const auto looked_at = [&](const Vector3d& point, const Vector3d& normal, double least_agreement) {
        int count = 0;
        double least = std::numeric_limits<double>::max();
        tree.search(
            [&](const FacetTree::Bounds& bounds) {
                const double agreement = normal.cwiseProduct(bounds.normals.min())
                                             .cwiseMax(normal.cwiseProduct(bounds.normals.max()))
                                             .sum();
                return agreement > least_agreement ? bounds.places.squaredExteriorDistance(point)
                                                   : std::numeric_limits<double>::infinity();
            },
            least,
            [&](int f) {
                ++count;
                if (n.row(f).dot(normal) > least_agreement)
                    least = std::min(least, (mesh.V.row(mesh.F(f, 0)).transpose() - point).squaredNorm());
            });
        return count;
    };
    const Vector3d point(0.37, 0.61, 0.05);
    CHECK(looked_at(point, {0, 0, 1}, 0.3) < 100);     // of 20,000
    CHECK(looked_at(point, {0, 0, -1}, 0.3) == 0);     // all face up
    CHECK(looked_at(point, {1, 0, 0}, 0.3) == 0);      // none is that steep
    CHECK(looked_at(point, {1, 0, 0}, 0.1755) < 500);  // few are
}
