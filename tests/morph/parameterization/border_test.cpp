#include "morph/parameterization/border.h"

#include <algorithm>
#include <ctime>
#include <random>

#include "morph/exact/predicates.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

namespace {

/// Points on the unit circle at the given angles in turns.
Points on_circle(const std::vector<double>& turns) {
    Points points(static_cast<Eigen::Index>(turns.size()), 3);
    for (std::size_t k = 0; k < turns.size(); ++k) {
        const double angle = 2.0 * std::numbers::pi * turns[k];
        points.row(static_cast<Eigen::Index>(k)) << std::cos(angle), std::sin(angle), 0.0;
    }
    return points;
}

Points regular(int n) {
    std::vector<double> turns;
    for (int k = 0; k < n; ++k) turns.push_back(static_cast<double>(k) / n);
    return on_circle(turns);
}

bool strictly_convex(const Points& rays) {
    const Eigen::Index n = rays.rows();
    for (Eigen::Index k = 0; k < n; ++k) {
        if (orientation(rays.row(k), rays.row((k + 1) % n), rays.row((k + 2) % n)) <= 0) return false;
    }
    return true;
}

/// What must hold for every union, whatever the loops.
void check_union(const BorderUnion& u, int na, int nb) {
    REQUIRE(u.size() >= std::max(na, nb));
    REQUIRE(u.size() == na + nb - u.shared);
    REQUIRE(u.shared >= 1);
    REQUIRE(static_cast<int>(u.source.size()) == u.size());
    REQUIRE(static_cast<int>(u.target.size()) == u.size());
    REQUIRE(u.angles[0] == 0.0);
    bool increasing = u.angles[u.size() - 1] < 2.0 * std::numbers::pi;
    for (int k = 0; k + 1 < u.size(); ++k) increasing = increasing && u.angles[k] < u.angles[k + 1];
    CHECK(increasing);
    CHECK(strictly_convex(border_rays(u.angles)));
    // Either loop passes all its vertices once, in order, and points between neighbours in order of the
    // ratio.
    for (const auto& [sites, n] : {std::pair(u.source, na), std::pair(u.target, nb)}) {
        int vertices = 0;
        bool in_order = sites[0].is_vertex();
        for (std::size_t k = 0; k < sites.size(); ++k) {
            if (sites[k].is_vertex()) {
                in_order = in_order && sites[k].from == (sites[0].from + vertices) % n;
                ++vertices;
            } else {
                const double before = sites[k - 1].is_vertex() ? 0.0 : sites[k - 1].ratio;
                in_order = in_order && sites[k].from == (sites[0].from + vertices - 1) % n &&
                           sites[k].to == (sites[k].from + 1) % n && sites[k].ratio > before &&
                           sites[k].ratio < 1.0;
            }
        }
        CHECK(in_order);
        CHECK(vertices == n);
    }
}

/// What must hold for a mesh into which a union's vertices were inserted.
void check_bordered(const Mesh& input, const std::vector<int>& loop, const BorderedMesh& bordered) {
    const Mesh& mesh = bordered.mesh;
    REQUIRE(mesh.vertex_count() == input.vertex_count() + static_cast<int>(bordered.inserted.size()));
    REQUIRE(mesh.triangle_count() == input.triangle_count() + static_cast<int>(bordered.parent.size()));
    CHECK(mesh.V.topRows(input.vertex_count()) == input.V);
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());  // throws unless manifold
    CHECK(euler_characteristic(topology) ==
          euler_characteristic(connectivity(input.F, input.vertex_count())));
    const auto loops = boundary_loops(mesh, topology);
    REQUIRE(loops.size() == 1);
    REQUIRE(loops[0].size() == bordered.loop.size());
    std::vector<int> rotated = loops[0];
    std::rotate(rotated.begin(), std::find(rotated.begin(), rotated.end(), bordered.loop[0]), rotated.end());
    CHECK(rotated == bordered.loop);

    for (std::size_t k = 0; k < bordered.inserted.size(); ++k) {
        const auto [from, to, ratio] = bordered.inserted[k];
        const Eigen::RowVector3d p = mesh.V.row(input.vertex_count() + static_cast<Eigen::Index>(k));
        const Eigen::RowVector3d expected = input.V.row(from) + ratio * (input.V.row(to) - input.V.row(from));
        CHECK((p - expected).norm() <= 1e-15 * (1.0 + expected.norm()));
        CHECK(std::find(loop.begin(), loop.end(), from) != loop.end());
    }
    // Areas triangle by triangle: the parts of a triangle make up the triangle, none of them without area.
    const Eigen::VectorXd before = triangle_areas(input), after = triangle_areas(mesh);
    Eigen::VectorXd sum = after.head(input.triangle_count());
    for (std::size_t k = 0; k < bordered.parent.size(); ++k) {
        sum[bordered.parent[k]] += after[input.triangle_count() + static_cast<Eigen::Index>(k)];
    }
    CHECK((sum - before).cwiseAbs().maxCoeff() <= 1e-12 * before.sum());
    CHECK(after.sum() == Approx(before.sum()).epsilon(1e-12));
}

}  // namespace

TEST_CASE("arc-length angles are proportional to edge lengths and begin at the control vertex") {
    Points loop(4, 3);
    loop << 0, 0, 0, 3, 0, 0, 3, 1, 0, 0, 1, 0;  // a 3 x 1 rectangle: perimeter 8
    const double turn = 2.0 * std::numbers::pi;
    const Eigen::VectorXd angles = arc_length_angles(loop, 1);
    CHECK(angles[0] == 0.0);
    CHECK(angles[1] == Approx(turn * 1 / 8).epsilon(1e-15));
    CHECK(angles[2] == Approx(turn * 4 / 8).epsilon(1e-15));
    CHECK(angles[3] == Approx(turn * 5 / 8).epsilon(1e-15));
}

TEST_CASE("the union of a hexagon and a square has eight vertices at known places") {
    const BorderUnion u = border_union(regular(6), regular(4), {});
    check_union(u, 6, 4);
    REQUIRE(u.size() == 8);
    CHECK(u.shared == 2);
    const double expected[] = {0, 60, 90, 120, 180, 240, 270, 300};
    for (int k = 0; k < 8; ++k)
        CHECK(u.angles[k] * 180.0 / std::numbers::pi == Approx(expected[k]).margin(1e-12));
    CHECK(u.target[1].from == 0);
    CHECK(u.target[1].to == 1);
    CHECK(u.target[1].ratio == Approx(2.0 / 3.0).epsilon(1e-14));
    CHECK(u.source[2].ratio == Approx(0.5).epsilon(1e-14));
    CHECK(position(regular(6), u.source[2]).isApprox(Eigen::Vector3d(0, std::sqrt(0.75), 0), 1e-14));
}

TEST_CASE("equal borders share every vertex and nothing is inserted") {
    const Mesh mesh = disks::dome(6, 0.7);
    const std::vector<int> loop = disks::border_of(mesh);
    BorderControl control;
    control.source = control.target = 5;
    Mesh moved = mesh;  // the same shape in another place, at another scale and written with six digits
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        for (int k = 0; k < 3; ++k) moved.V(v, k) = std::round((3.0 * mesh.V(v, k) + 7.0) * 1e6) / 1e6;
    }
    const CommonBorder border = common_border(mesh, loop, moved, loop, control);
    CHECK(border.shared == static_cast<int>(loop.size()));
    CHECK(border.source.inserted.empty());
    CHECK(border.target.inserted.empty());
    CHECK(border.source.mesh.F == mesh.F);
    CHECK(border.source.loop[0] == loop[5]);
}

TEST_CASE("both meshes get the same border and keep their surfaces") {
    // Ears, chords, triangles on the border with all corners, loops of three, many insertions on one edge.
    const std::vector<std::pair<const char*, Mesh>> meshes{
        {"dome", disks::dome(5, 1.0)},         {"fine dome", disks::dome(25, 0.5)},
        {"grid", disks::grid(4, 3)},           {"one square", disks::grid(1, 1)},
        {"row of squares", disks::grid(9, 1)}, {"one triangle", disks::polygon(3)},
        {"polygon", disks::polygon(17)},       {"cone of three", disks::cone(regular(3), 0.5)},
        {"cone", disks::cone(regular(40), 2)}};
    for (const auto& [name_a, a] : meshes) {
        for (const auto& [name_b, b] : meshes) {
            INFO(name_a << " and " << name_b);
            const std::vector<int> loop_a = disks::border_of(a), loop_b = disks::border_of(b);
            const int na = static_cast<int>(loop_a.size()), nb = static_cast<int>(loop_b.size());
            BorderControl control;
            control.source = na / 3;
            control.target = nb - 1;
            check_union(border_union(loop_points(a, loop_a), loop_points(b, loop_b), control), na, nb);
            const CommonBorder border = common_border(a, loop_a, b, loop_b, control);
            REQUIRE(border.source.loop.size() == border.target.loop.size());
            REQUIRE(static_cast<Eigen::Index>(border.source.loop.size()) == border.angles.size());
            check_bordered(a, loop_a, border.source);
            check_bordered(b, loop_b, border.target);
            CHECK(triangle_areas(border.source.mesh).minCoeff() > 0.0);
            CHECK(triangle_areas(border.target.mesh).minCoeff() > 0.0);
        }
    }
}

TEST_CASE("exchanging source and target gives the same union") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    std::vector<double> a{0.0}, b{0.0};
    for (int k = 0; k < 300; ++k) a.push_back(place(random));
    for (int k = 0; k < 500; ++k) b.push_back(place(random));
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    const BorderUnion ab = border_union(on_circle(a), on_circle(b), {}),
                      ba = border_union(on_circle(b), on_circle(a), {});
    REQUIRE(ab.size() == ba.size());
    CHECK(ab.angles == ba.angles);
    for (int k = 0; k < ab.size(); ++k) {
        CHECK(ab.source[static_cast<std::size_t>(k)].from == ba.target[static_cast<std::size_t>(k)].from);
        CHECK(ab.source[static_cast<std::size_t>(k)].ratio == ba.target[static_cast<std::size_t>(k)].ratio);
    }
}

TEST_CASE("nasty borders give a strictly convex polygon and a one-to-one, monotone matching") {
    for (unsigned seed = 1; seed <= 400; ++seed) {
        INFO("seed " << seed);
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> exponent(-9.0, 0.0), chance(0.0, 1.0);
        // Edge lengths from 1e-9 to 1, some of them zero; the target repeats stretches of the source.
        const auto lengths = [&](int n) {
            std::vector<double> l;
            for (int k = 0; k < n; ++k)
                l.push_back(chance(random) < 0.1 ? 0.0 : std::pow(10.0, exponent(random)));
            return l;
        };
        const int na = 3 + static_cast<int>(random() % 200);
        std::vector<double> a = lengths(na), b = a;
        if (seed % 2 == 0) b = lengths(3 + static_cast<int>(random() % 200));
        for (double& length : b) {
            if (chance(random) < 0.1) length *= 1.0 + 1e-6 * chance(random);
        }
        a.front() = b.front() = 1.0;
        // A path there and back along one line has any edge lengths: the way back is one edge.
        const auto path = [](const std::vector<double>& l) {
            Points points = Points::Zero(static_cast<Eigen::Index>(l.size()), 3);
            for (Eigen::Index k = 1; k < points.rows(); ++k)
                points(k, 0) = points(k - 1, 0) + l[static_cast<std::size_t>(k)];
            return points;
        };
        const Points loop_a = path(a), loop_b = path(b);
        const BorderUnion u = border_union(loop_a, loop_b, {});
        check_union(u, static_cast<int>(loop_a.rows()), static_cast<int>(loop_b.rows()));
        check_union(mirrored(mirrored(u)), u.source_size, u.target_size);
        CHECK(strictly_convex(border_rays(mirrored(u).angles)));
        if (seed > 40) continue;
        Mesh cone = disks::cone(loop_a, 1.0), other = disks::cone(loop_b, 1.0);
        cone.V(cone.vertex_count() - 1, 1) = other.V(other.vertex_count() - 1, 1) = 1.0;
        std::vector<int> cone_loop(static_cast<std::size_t>(loop_a.rows())),
            other_loop(static_cast<std::size_t>(loop_b.rows()));
        for (std::size_t k = 0; k < cone_loop.size(); ++k) cone_loop[k] = static_cast<int>(k);
        for (std::size_t k = 0; k < other_loop.size(); ++k) other_loop[k] = static_cast<int>(k);
        const CommonBorder border = common_border(cone, cone_loop, other, other_loop, {});
        check_bordered(cone, cone_loop, border.source);
        check_bordered(other, other_loop, border.target);
    }
}

TEST_CASE("the smallest gap keeps a whole polygon of such gaps strictly convex, wherever it lies") {
    for (const double first : {0.0, 0.7, 1.5707, 2.3, 3.1415, 4.0, 5.5}) {
        Eigen::VectorXd angles(2000);
        for (int k = 0; k < 1999; ++k) angles[k] = first + k * kMinimumGap;
        angles[1999] = first + 0.5;
        const Points rays = border_rays(angles);
        bool convex = true;
        for (int k = 0; k + 2 < 2000; ++k)
            convex = convex && orientation(rays.row(k), rays.row(k + 1), rays.row(k + 2)) > 0;
        CHECK(convex);
    }
}

TEST_CASE("vertices of one loop closer than the snap tolerance are not merged with one another") {
    // Source: three vertices within 1e-7 turns of angle 1/2; target: one there. One is matched, two are
    // inserted.
    const double near = 0.2 * kBorderSnap;
    const Points a = on_circle({0.0, 0.25, 0.5 - near, 0.5, 0.5 + near, 0.75}),
                 b = on_circle({0.0, 0.25, 0.5, 0.75});
    const BorderUnion u = border_union(a, b, {});
    check_union(u, 6, 4);
    CHECK(u.shared == 4);
    CHECK(u.size() == 6);
}

TEST_CASE("the mirrored union gives the second half of a cut shape the same border to the last bit") {
    // Two cut shapes: an upper and a lower dome each over the same cut points, the lower one's loop the other
    // way round.
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    const auto cut = [&](int n) {
        std::vector<double> turns{0.0};
        for (int k = 1; k < n; ++k) turns.push_back(place(random));
        std::sort(turns.begin(), turns.end());
        return on_circle(turns);
    };
    const Points cut_a = cut(37), cut_b = cut(52);
    const auto below = [](const Points& points) {
        Points other(points.rows(), 3);
        for (Eigen::Index k = 0; k < points.rows(); ++k)
            other.row(k) = points.row((points.rows() - k) % points.rows());
        return other;
    };
    const auto loop = [](Eigen::Index n) {
        std::vector<int> l(static_cast<std::size_t>(n));
        for (std::size_t k = 0; k < l.size(); ++k) l[k] = static_cast<int>(k);
        return l;
    };
    BorderControl control;
    control.source = 5;
    control.target = 40;
    const BorderUnion u = border_union(cut_a, cut_b, control), m = mirrored(u);
    REQUIRE(m.size() == u.size());
    CHECK(m.angles[0] == 0.0);
    CHECK(strictly_convex(border_rays(m.angles)));
    for (const auto& [points, sites, other_sites] :
         {std::tuple(cut_a, u.source, m.source), std::tuple(cut_b, u.target, m.target)}) {
        const Mesh upper = disks::cone(points, 1.0), lower = disks::cone(below(points), -1.0);
        const BorderedMesh half0 = insert_border(upper, loop(points.rows()), sites);
        const BorderedMesh half1 = insert_border(lower, loop(points.rows()), other_sites);
        check_bordered(upper, loop(points.rows()), half0);
        check_bordered(lower, loop(points.rows()), half1);
        const int n = u.size();
        bool same = true;
        for (int k = 0; k < n; ++k) {
            const auto here = half0.mesh.V.row(half0.loop[static_cast<std::size_t>(k)]);
            const auto there = half1.mesh.V.row(half1.loop[static_cast<std::size_t>((n - k) % n)]);
            same = same && here == there;
        }
        CHECK(same);
    }
}

TEST_CASE("a border of a million vertices is united in time n log n") {
    const Points a = regular(500000), b = regular(499999);
    const std::clock_t begin = std::clock();
    const BorderUnion u = border_union(a, b, {});
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    CHECK(u.size() <= 999999);
    CHECK(u.size() >= 500000);
    CHECK(seconds < 5.0);  // of the processor; 0.2 s is usual, a quadratic method takes minutes
    const Points rays = border_rays(u.angles);
    CHECK(strictly_convex(rays));
}

TEST_CASE("a loop that is not the mesh's border is refused with the counts") {
    const Mesh mesh = disks::flat(3);
    std::vector<int> loop = disks::border_of(mesh);
    std::reverse(loop.begin(), loop.end());
    const BorderUnion u = border_union(loop_points(mesh, loop), regular(5), {});
    CHECK_THROWS_AS(insert_border(mesh, loop, u.source), InvalidMesh);
}
