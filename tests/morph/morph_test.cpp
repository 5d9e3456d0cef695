#include "morph/morph.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;
using Eigen::Vector3d;

namespace {

const Eigen::Matrix3d kTurn = Eigen::AngleAxisd(2.1, Vector3d(1, 2, -1).normalized()).toRotationMatrix();

/// An open, lopsided dome over the unit disk: n rings, with `bump` height. No symmetry.
Mesh dome(int n, double bump, double twist) {
    Mesh mesh;
    mesh.V.resize(1 + 3 * n * (n + 1), 3);
    const auto height = [&](double x, double y) {
        return 0.6 * (1 - x * x - 0.6 * y * y) +
               bump * std::exp(-8 * ((x - 0.4) * (x - 0.4) + (y - 0.2) * (y - 0.2)));
    };
    int v = 0;
    std::vector<int> first{0};
    mesh.V.row(v++) << 0, 0, height(0, 0);
    std::vector<Eigen::RowVector3i> faces;
    for (int ring = 1; ring <= n; ++ring) {
        first.push_back(v);
        for (int k = 0; k < 6 * ring; ++k) {
            const double r = static_cast<double>(ring) / n,
                         angle = 2 * M_PI * (k + twist * ring) / (6 * ring);
            const double x = r * std::cos(angle), y = 0.8 * r * std::sin(angle);
            mesh.V.row(v++) << x, y, height(x, y);
        }
    }
    for (int ring = 1; ring <= n; ++ring) {
        const int outer = 6 * ring, inner = std::max(1, 6 * (ring - 1));
        int i = 0, o = 0;  // zipper between two rings
        while (o < outer || (ring > 1 && i < inner)) {
            const int a = first[static_cast<std::size_t>(ring)] + o % outer;
            const int b = first[static_cast<std::size_t>(ring - 1)] + i % inner;
            const bool step_out =
                ring == 1 || i >= inner || (o < outer && (o + 1) * inner <= (i + 1) * outer);
            if (step_out) {
                faces.push_back({b, a, first[static_cast<std::size_t>(ring)] + (o + 1) % outer});
                ++o;
            } else {
                faces.push_back({b, a, first[static_cast<std::size_t>(ring - 1)] + (i + 1) % inner});
                ++i;
            }
        }
    }
    mesh.F.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f) mesh.F.row(static_cast<Eigen::Index>(f)) = faces[f];
    return mesh;
}

Mesh moved(Mesh mesh, const Eigen::Matrix3d& R, const Vector3d& t, double scale = 1.0) {
    for (int v = 0; v < mesh.vertex_count(); ++v)
        mesh.V.row(v) = (scale * R * mesh.V.row(v).transpose() + t).transpose();
    return mesh;
}

/// Removes the triangles whose centre is within `radius` of (x, y): an opening.
Mesh with_opening(const Mesh& mesh, double x, double y, double radius) {
    Mesh open = mesh;
    int kept = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        Vector3d centre = Vector3d::Zero();
        for (int k = 0; k < 3; ++k) centre += mesh.V.row(mesh.F(f, k)).transpose() / 3.0;
        if (std::hypot(centre.x() - x, centre.y() - y) > radius) open.F.row(kept++) = mesh.F.row(f);
    }
    open.F.conservativeResize(kept, 3);
    return open;
}

/// Removes the triangles with a corner above the height z, and vertices that nothing uses.
Mesh with_opening_above(const Mesh& mesh, double z) {
    Mesh open = mesh;
    int kept = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        if (std::max({mesh.V(mesh.F(f, 0), 2), mesh.V(mesh.F(f, 1), 2), mesh.V(mesh.F(f, 2), 2)}) <= z)
            open.F.row(kept++) = mesh.F.row(f);
    }
    open.F.conservativeResize(kept, 3);
    return admit_mesh(open).mesh;
}

/// Every vertex of the input is a vertex of the merged shape, bit for bit.
void check_holds_vertices(const Points& merged, const Mesh& input) {
    std::set<std::array<double, 3>> places;
    for (int v = 0; v < merged.rows(); ++v) places.insert({merged(v, 0), merged(v, 1), merged(v, 2)});
    int missing = 0;
    for (int v = 0; v < input.vertex_count(); ++v) {
        missing += places.count({input.V(v, 0), input.V(v, 1), input.V(v, 2)}) == 0;
    }
    CHECK(missing == 0);
}

/// Number of undirected edges that are not used once in either direction.
int unmatched_edges(const Triangles& F) {
    std::map<std::pair<int, int>, int> directed;
    for (int f = 0; f < F.rows(); ++f) {
        for (int k = 0; k < 3; ++k) ++directed[{F(f, k), F(f, (k + 1) % 3)}];
    }
    int unmatched = 0;
    for (const auto& [edge, count] : directed) {
        const auto twin = directed.find({edge.second, edge.first});
        unmatched += count != 1 || twin == directed.end();
    }
    return unmatched;
}

double area(const Points& V, const Triangles& F) {
    return triangle_areas({V, F}).sum();
}

void check_reproduces_both(const Morph& result, const Mesh& source, const Mesh& target) {
    check_holds_vertices(result.frame(0), source);
    check_holds_vertices(result.frame(1), target);
    CHECK(area(result.frame(0), result.triangles()) == Approx(area(source.V, source.F)).epsilon(1e-9));
    CHECK(area(result.frame(1), result.triangles()) == Approx(area(target.V, target.F)).epsilon(1e-9));
    for (const MapReport& map : result.report().maps) CHECK(map.flipped == 0);
}

}  // namespace

TEST_CASE("an open pair becomes one connectivity that reproduces both inputs") {
    const InputMesh source = admit_mesh(dome(12, 0.5, 0.0));
    const InputMesh target = admit_mesh(moved(dome(15, 0.4, 0.4), kTurn, {3, -2, 5}, 2.5));
    const Morph result = morph(source, target, {.lift = false});
    check_reproduces_both(result, source.mesh, target.mesh);

    const Connectivity topology = connectivity(result.triangles(), static_cast<int>(result.frame(0).rows()));
    CHECK(euler_characteristic(topology) == 1);
    CHECK(boundary_loops(result.mesh(0), topology).size() == 1);

    const OverlayReport& overlay = result.report().overlays.at(0);
    CHECK(overlay.vertices ==
          overlay.vertices_a + overlay.vertices_b + overlay.crossings - overlay.coincident);
    CHECK(overlay.zero_area_a == 0);
    CHECK(overlay.zero_area_b == 0);
}

TEST_CASE("lifting keeps every input vertex at its place") {
    const InputMesh source = admit_mesh(dome(8, 0.5, 0.0)), target = admit_mesh(dome(9, 0.3, 0.3));
    const Morph result = morph(source, target);
    check_holds_vertices(result.frame(0), source.mesh);
    check_holds_vertices(result.frame(1), target.mesh);
}

TEST_CASE(
    "a closed pair is watertight and reproduces both inputs, by way of the sphere or cut and glued again") {
    const InputMesh source = admit_mesh(ellipsoid({1.0, 0.7, 0.5}, {.triangles = 900, .seed = 3}));
    const InputMesh target =
        admit_mesh(star({}, {.triangles = 1100, .seed = 4, .rotation = kTurn, .translation = {2, 0, 1}}));
    for (const Domain domain : {Domain::Auto, Domain::Cut}) {
        const std::string expected = domain == Domain::Cut ? "cut into two disks" : "sphere";
        for (const Alignment alignment : {Alignment::Registration, Alignment::None, Alignment::Features}) {
            const Morph result =
                morph(source, target, {.alignment = alignment, .domain = domain, .lift = false});
            check_reproduces_both(result, source.mesh, target.mesh);
            CHECK(unmatched_edges(result.triangles()) == 0);
            const Connectivity topology =
                connectivity(result.triangles(), static_cast<int>(result.frame(0).rows()));
            CHECK(euler_characteristic(topology) == 2);
            CHECK(result.report().registration.used == (alignment != Alignment::None));
            CHECK(result.report().features.size() ==
                  (alignment == Alignment::Features && domain == Domain::Cut ? 2 : 0));
            CHECK(result.report().domain == expected);
            CHECK(result.report().overlays.size() == (domain == Domain::Cut ? 2 : 1));
            CHECK((result.report().sphere_alignment.matches > 0) ==
                  (domain != Domain::Cut && alignment != Alignment::None));
        }
        const Morph lifted = morph(source, target, {.domain = domain});
        check_holds_vertices(lifted.frame(0), source.mesh);
        CHECK(unmatched_edges(lifted.triangles()) == 0);
    }
}

TEST_CASE("closed shapes in any position correspond on the sphere") {
    const StarParameters parameters;
    const Mesh a = star(parameters, {.triangles = 2500, .seed = 1});
    const Mesh b = star(parameters, {.triangles = 2000, .seed = 2});
    // Lopsided, so that only one pose fits.
    const auto lopsided = [](Mesh mesh) {
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            mesh.V(v, 0) += 0.4 * mesh.V(v, 0) * mesh.V(v, 0) + 0.2 * mesh.V(v, 1) * mesh.V(v, 1);
            mesh.V(v, 2) += 0.5 * mesh.V(v, 1) * mesh.V(v, 0);
        }
        return mesh;
    };
    const double diagonal = 2.5 * bounding_box_diagonal(b.V);
    const Points truth = moved(lopsided(a), kTurn, {3, -2, 5}, 2.5).V;
    for (const Alignment alignment : {Alignment::Registration, Alignment::Dense}) {
        const Morph result =
            morph(admit_mesh(lopsided(a)), admit_mesh(moved(lopsided(b), kTurn, {3, -2, 5}, 2.5)),
                  {.alignment = alignment});
        const double error = (result.correspondence() - truth).rowwise().norm().mean() / diagonal;
        CHECK(error < (alignment == Alignment::Dense ? 0.003 : 0.01));
        CHECK(result.report().alignment.used == (alignment == Alignment::Dense));
    }
}

TEST_CASE(
    "an open pair that the disk squeezes goes to the sphere with its border locked, and the report says "
    "why") {
    // Balls with a small opening: nearly all of the surface is far from the border.
    const auto ball = [](double size, int triangles, std::uint64_t seed, double bump) {
        Mesh mesh = ellipsoid({1, 0.9, 0.8}, {.triangles = triangles, .seed = seed});
        for (int v = 0; v < mesh.vertex_count(); ++v) mesh.V(v, 0) += bump * mesh.V(v, 1) * mesh.V(v, 1);
        return with_opening_above(mesh, size);
    };
    const InputMesh source = admit_mesh(ball(0.73, 2000, 1, 0.3)),
                    target = admit_mesh(moved(ball(0.73, 1700, 2, 0.2), kTurn, {1, 2, 3}));
    const Morph result = morph(source, target, {.lift = false});
    CHECK(result.report().domain == "sphere, border locked");
    REQUIRE(!result.report().notes.empty());
    CHECK(result.report().notes.back().find("p01") != std::string::npos);
    check_reproduces_both(result, source.mesh, target.mesh);
    const Connectivity topology = connectivity(result.triangles(), static_cast<int>(result.frame(0).rows()));
    CHECK(euler_characteristic(topology) == 1);
    CHECK(boundary_loops(result.mesh(0), topology).size() == 1);
    for (const MapReport& map : result.report().maps) CHECK(map.p01 > 0.1);

    const Morph disk = morph(source, target, {.domain = Domain::Disk, .lift = false});
    CHECK(disk.report().domain == "disk");
    check_reproduces_both(disk, source.mesh, target.mesh);
    CHECK(disk.report().maps.at(0).p01 < 0.1);
}

TEST_CASE("a good disk map keeps an open pair on the disk, unless the sphere is asked for") {
    const InputMesh source = admit_mesh(dome(10, 0.5, 0.0)), target = admit_mesh(dome(11, 0.3, 0.3));
    CHECK(morph(source, target).report().domain == "disk");
    const Morph result = morph(source, target, {.domain = Domain::Sphere, .lift = false});
    CHECK(result.report().domain == "sphere, border locked");
    check_reproduces_both(result, source.mesh, target.mesh);
}

TEST_CASE("the maps of a morph are kept on request, as they were overlaid") {
    const InputMesh open_a = admit_mesh(with_opening(dome(10, 0.5, 0.0), -0.3, 0.1, 0.2)),
                    open_b = admit_mesh(with_opening(dome(11, 0.3, 0.3), -0.3, 0.1, 0.2));
    const InputMesh closed_a = admit_mesh(ellipsoid({1, 0.8, 0.5}, {.triangles = 400})),
                    closed_b = admit_mesh(star({}, {.triangles = 500}));
    CHECK(morph(open_a, open_b).maps().empty());

    const auto check_maps = [](const Morph& result, std::size_t parts, bool on_disk) {
        REQUIRE(result.maps().size() == parts);
        for (std::size_t i = 0; i < parts; ++i) {
            const DomainMaps& maps = result.maps()[i];
            CHECK(maps.source.mesh.vertex_count() == result.report().overlays[i].vertices_a);
            CHECK(maps.target.mesh.vertex_count() == result.report().overlays[i].vertices_b);
            for (const DomainMap* map : {&maps.source, &maps.target}) {
                CHECK(map->on_disk() == on_disk);
                REQUIRE(map->rays.rows() == map->mesh.vertex_count());
                REQUIRE(static_cast<int>(map->is_filling.size()) == map->mesh.triangle_count());
                if (!on_disk) CHECK((map->rays.rowwise().norm().array() - 1.0).abs().maxCoeff() < 1e-12);
                int turned = 0;
                for (int f = 0; f < map->mesh.triangle_count(); ++f) {
                    const Vector3d a = map->rays.row(map->mesh.F(f, 0)), b = map->rays.row(map->mesh.F(f, 1)),
                                   c = map->rays.row(map->mesh.F(f, 2));
                    turned += a.dot(b.cross(c)) <= 0.0;
                }
                CHECK(turned == 0);
            }
            REQUIRE(maps.source.loop.size() == maps.target.loop.size());
            for (std::size_t k = 0; k < maps.source.loop.size(); ++k)
                CHECK(maps.source.rays.row(maps.source.loop[k]) == maps.target.rays.row(maps.target.loop[k]));
        }
    };
    const Morph disk = morph(open_a, open_b, {.domain = Domain::Disk, .keep_maps = true});
    check_maps(disk, 1, true);
    CHECK(disk.maps()[0].part.empty());
    for (const DomainMap* map : {&disk.maps()[0].source, &disk.maps()[0].target})
        CHECK(std::count(map->is_filling.begin(), map->is_filling.end(), 1) > 5);
    check_maps(morph(open_a, open_b, {.domain = Domain::Sphere, .keep_maps = true}), 1, false);
    check_maps(morph(closed_a, closed_b, {.keep_maps = true}), 1, false);
    const Morph cut = morph(closed_a, closed_b, {.domain = Domain::Cut, .keep_maps = true});
    check_maps(cut, 2, true);
    CHECK(cut.maps()[0].part == "half 1");
    CHECK(cut.maps()[1].part == "half 2");
}

TEST_CASE("a domain that does not fit is refused with a reason") {
    const InputMesh open = admit_mesh(dome(5, 0.5, 0.0), "dome"),
                    closed = admit_mesh(ellipsoid({1, 1, 1}, {.triangles = 200}), "ball");
    CHECK_THROWS_AS(morph(open, open, {.domain = Domain::Cut}), InvalidMesh);
    CHECK_THROWS_AS(morph(closed, closed, {.domain = Domain::Disk}), InvalidMesh);
    CHECK_THROWS_AS(morph(open, closed, {.domain = Domain::Disk}), InvalidMesh);
    CHECK_THROWS_AS(morph(closed, open, {.domain = Domain::Cut}), InvalidMesh);
}

TEST_CASE("a shape and its turned copy correspond, and slerp frames are rigid copies") {
    const Mesh shape = dome(12, 0.5, 0.0);
    const InputMesh source = admit_mesh(shape), target = admit_mesh(moved(shape, kTurn, {1, 2, 3}));
    const Morph result = morph(source, target);
    const Report& report = result.report();
    const Eigen::Matrix3d R =
        Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(report.registration.rotation.data());
    CHECK((R - kTurn).norm() < 1e-6);
    CHECK((result.correspondence() - target.mesh.V).rowwise().norm().maxCoeff() < 1e-5);
    const double whole = area(result.frame(0), result.triangles());
    for (const double alpha : {0.25, 0.5, 0.75}) {
        CHECK(area(result.frame(alpha), result.triangles()) == Approx(whole).epsilon(1e-5));
        CHECK(area(result.frame(alpha, Interpolation::Linear), result.triangles()) < 0.95 * whole);
    }
}

TEST_CASE("the ends are exact for every interpolation") {
    const Morph result =
        morph(admit_mesh(dome(6, 0.5, 0.0)), admit_mesh(moved(dome(7, 0.2, 0.2), kTurn, {1, 0, 0})));
    for (const auto scheme : {Interpolation::Linear, Interpolation::RigidLinear, Interpolation::Slerp}) {
        CHECK(result.frame(0, scheme) == result.endpoints().a);
        CHECK(result.frame(1, scheme) == result.endpoints().b);
    }
}

TEST_CASE("openings are filled for the maps and opened again") {
    const InputMesh source = admit_mesh(with_opening(dome(14, 0.5, 0.0), -0.3, 0.1, 0.2));
    const InputMesh target =
        admit_mesh(moved(with_opening(dome(15, 0.5, 0.3), -0.3, 0.1, 0.22), kTurn, {0, 1, 0}));
    const Morph opened = morph(source, target);
    CHECK(opened.report().reopened_triangles > 0);
    const auto loops = [](const Morph& m) {
        return boundary_loops(m.mesh(0), connectivity(m.triangles(), static_cast<int>(m.frame(0).rows())))
            .size();
    };
    CHECK(loops(opened) == 2);
    const Morph filled = morph(source, target, {.openings = Openings::Fill});
    CHECK(loops(filled) == 1);
    CHECK(filled.triangles().rows() == opened.triangles().rows() + opened.report().reopened_triangles);
}

TEST_CASE("a target that faces the other way is noticed by its border's direction") {
    Mesh turned = dome(13, 0.5, 0.2);
    turned.F.col(1).swap(turned.F.col(2));
    const Morph result = morph(admit_mesh(dome(12, 0.5, 0.0)), admit_mesh(turned));
    CHECK(result.report().target_reversed);
    CHECK((result.correspondence() - dome(12, 0.5, 0.0).V).rowwise().norm().mean() < 0.05);
}

TEST_CASE("the correspondence follows the file's vertices, unused ones too") {
    Mesh source = dome(8, 0.5, 0.0);
    Points with_unused(source.vertex_count() + 1, 3);
    with_unused << 9, 9, 9, source.V;
    source.V = with_unused;
    source.F.array() += 1;
    const Morph result = morph(admit_mesh(source), admit_mesh(dome(8, 0.5, 0.0)));
    const Points correspondence = result.correspondence();
    REQUIRE(correspondence.rows() == source.vertex_count());
    CHECK(correspondence.row(0).array().isNaN().all());
    CHECK((correspondence.bottomRows(source.vertex_count() - 1) - dome(8, 0.5, 0.0).V)
              .rowwise()
              .norm()
              .maxCoeff() < 1e-5);
}

TEST_CASE("an open shape beside a closed one is capped for the map, and the cap is opened again") {
    const Mesh ball = ellipsoid({1, 0.9, 0.8}, {.triangles = 1200});
    Mesh cup = with_opening_above(ellipsoid({1, 0.9, 0.8}, {.triangles = 1000, .seed = 5}), 0.3);
    const InputMesh closed = admit_mesh(ball, "ball");
    for (const bool inwards : {false, true}) {
        if (inwards) cup.F.col(1).swap(cup.F.col(2));
        const InputMesh open = admit_mesh(cup, "cup");
        for (const bool open_first : {true, false}) {
            const Morph result =
                open_first ? morph(open, closed, {.lift = false}) : morph(closed, open, {.lift = false});
            CHECK(result.report().domain == "sphere");
            CHECK(result.report().reopened_triangles > 0);
            const Mesh merged = result.mesh(open_first ? 0 : 1);
            CHECK(triangle_areas(merged).sum() == Approx(triangle_areas(cup).sum()).epsilon(1e-9));
            check_holds_vertices(merged.V, cup);
            const auto loops = boundary_loops(merged, connectivity(merged.F, merged.vertex_count()));
            CHECK(loops.size() == 1);
        }
        const Morph filled = morph(open, closed, {.openings = Openings::Fill});
        CHECK(unmatched_edges(filled.triangles()) == 0);
    }
}

TEST_CASE("the same input gives the same morph, and the report says what was done") {
    const InputMesh source = admit_mesh(dome(9, 0.5, 0.0)), target = admit_mesh(dome(10, 0.3, 0.3));
    const Morph first = morph(source, target), second = morph(source, target);
    CHECK(first.frame(0.3) == second.frame(0.3));
    CHECK(first.triangles() == second.triangles());
    const std::string json = report_json(first.report());
    for (const char* key :
         {"\"rotation\"", "\"weights\"", "\"crossings\"", "\"seconds\"", "\"confident\"", "\"features\""}) {
        CHECK(json.find(key) != std::string::npos);
    }
}

TEST_CASE("the note on an unsure registration names both residuals and why a worse pose was taken",
          "[sweep]") {
    // Half turns about its axes leave an ellipsoid as it is: which of the four poses fits best is up to the
    // tessellation, which is taken is not.
    const InputMesh source = admit_mesh(ellipsoid({1, 0.8, 0.6}, {.triangles = 600}));
    int better = 0, worse = 0;
    for (std::uint64_t seed = 2; seed < 8; ++seed) {
        const InputMesh target = admit_mesh(ellipsoid({1, 0.8, 0.6}, {.triangles = 600, .seed = seed}));
        const Report report =
            morph(source, target, {.alignment = Alignment::Registration, .lift = false}).report();
        const RegistrationReport& found = report.registration;
        REQUIRE_FALSE(found.confident);
        REQUIRE_FALSE(report.notes.empty());
        INFO(report.notes.front() << "; residual " << found.residual << ", other " << found.runner_up);
        const auto holds = [&](const char* text) {
            return report.notes.front().find(text) != std::string::npos;
        };
        (found.runner_up < found.residual ? better : worse) += 1;
        CHECK(holds("fits a little better") == (found.runner_up < found.residual));
        CHECK(holds("turns the source least is taken") == (found.runner_up < found.residual));
        CHECK(holds("fits nearly as well") == (found.runner_up >= found.residual));
    }
    CHECK(better > 0);
    CHECK(worse > 0);
}

TEST_CASE("a listener is told of every stage as it begins") {
    const InputMesh a = admit_mesh(ellipsoid({1, 0.8, 0.5}, {.triangles = 200})),
                    b = admit_mesh(ellipsoid({1, 0.9, 0.6}, {.triangles = 300}));
    std::vector<std::string> told;
    MorphOptions options;
    options.on_stage = [&](const std::string& stage) { told.push_back(stage); };
    const Morph result = morph(a, b, options);
    std::vector<std::string> finished;
    for (const StageReport& stage : result.report().stages) finished.push_back(stage.name);
    REQUIRE_FALSE(told.empty());
    CHECK(told.front() == "registration");
    std::sort(told.begin(), told.end());
    std::sort(finished.begin(), finished.end());
    CHECK(told == finished);
    CHECK_FALSE(result.report().on_stage);
}
