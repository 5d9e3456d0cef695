#include "morph/shapes/head.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/crop.h"
#include "morph/shapes/marching.h"
#include "morph/shapes/random.h"
#include "morph/shapes/sculpt.h"
#include "tests/catch.h"
#include "tests/morph/shapes/triangle_quality.h"

using namespace automorph;

namespace {

constexpr HeadPreset kPresets[] = {HeadPreset::Neutral,   HeadPreset::Asian, HeadPreset::Caucasian,
                                   HeadPreset::Narrow,    HeadPreset::Broad, HeadPreset::Child,
                                   HeadPreset::Caricature};

Mesh make(HeadCrop crop, int triangles, std::uint64_t seed = 1, HeadPreset preset = HeadPreset::Neutral) {
    HeadOptions options;
    options.parameters = head_parameters(preset);
    options.crop = crop;
    options.shape.triangles = triangles;
    options.shape.seed = seed;
    return head(options);
}

// Meshes that several tests look at.
const Mesh& closed_head() {
    static const Mesh mesh = make(HeadCrop::Closed, 8000);
    return mesh;
}
const Mesh& neutral_face() {
    static const Mesh mesh = make(HeadCrop::Face, 6000, 2);
    return mesh;
}

double distance(const ImplicitSurface& surface, const Eigen::Vector3d& p) {
    const FieldSample f = surface(p);
    return std::abs(f.value) / f.gradient.norm();
}

/// Farthest vertex from the surface, head heights.
double farthest(const Mesh& mesh, const ImplicitSurface& surface) {
    double most = 0.0;
    for (int v = 0; v < mesh.vertex_count(); ++v)
        most = std::max(most, distance(surface, mesh.V.row(v).transpose()));
    return most;
}

/// Least determinant of the deformation on a grid over the head.
double least_determinant(const HeadParameters& parameters, double step) {
    double least = std::numeric_limits<double>::infinity();
    for (double x = 0.0; x < 0.45; x += step) {
        for (double y = -0.75; y < 0.55; y += step) {
            for (double z = -0.5; z < 0.62; z += step)
                least = std::min(least, head_deformation_determinant(parameters, {x, y, z}));
        }
    }
    return least;
}

/// Triangles with an angle below 15 degrees.
int slivers(const Mesh& mesh) {
    int count = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        Mesh single;
        single.V.resize(3, 3);
        single.F.resize(1, 3);
        single.F << 0, 1, 2;
        for (int k = 0; k < 3; ++k) single.V.row(k) = mesh.V.row(mesh.F(f, k));
        count += triangle_quality(single).least_angle < 15.0;
    }
    return count;
}

FieldSample unit_sphere(const Eigen::Vector3d& p) {
    return {p.norm() - 1.0, p.normalized()};
}

}  // namespace

TEST_CASE("A closed head is one closed manifold of genus 0 with even triangles on the surface") {
    const Mesh& mesh = closed_head();
    CHECK(mesh.triangle_count() == 8000);
    const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
    CHECK(euler_characteristic(topology) == 2);
    CHECK(boundary_loops(mesh, topology).empty());
    CHECK(signed_volume(mesh) > 0.0);
    CHECK(farthest(mesh, head_surface()) < 1e-12);
    const TriangleQuality quality = triangle_quality(mesh);
    CHECK(slivers(mesh) <
          20);  // 0 to 15 for six seeds: in furrows of ears and lids, finer than the triangles
    CHECK(quality.mean_least_angle > 48.0);
}

TEST_CASE("Cropped heads are disks whose border lies on the surface and on the cut", "[sweep]") {
    for (const HeadCrop crop : {HeadCrop::Head, HeadCrop::Face}) {
        CAPTURE(static_cast<int>(crop));
        const Mesh mesh = crop == HeadCrop::Face ? neutral_face() : make(crop, 6000, 2);
        const Connectivity topology = connectivity(mesh.F, mesh.vertex_count());
        CHECK(euler_characteristic(topology) == 1);
        const auto loops = boundary_loops(mesh, topology);
        REQUIRE(loops.size() == 1);
        CHECK(std::abs(mesh.triangle_count() - 6000) < 300);
        CHECK(farthest(mesh, head_surface()) < 1e-12);
        double length = 0.0, turned = 0.0;  // the border's, and the sum of its corners' angles
        const std::size_t n = loops[0].size();
        for (std::size_t k = 0; k < n; ++k) {
            const Eigen::Vector3d a = mesh.V.row(loops[0][k]), b = mesh.V.row(loops[0][(k + 1) % n]),
                                  c = mesh.V.row(loops[0][(k + 2) % n]);
            length += (b - a).norm();
            turned += std::acos(std::clamp((b - a).normalized().dot((c - b).normalized()), -1.0, 1.0));
            const Eigen::Vector3d p = 23.0 * a;
            if (crop == HeadCrop::Head) {
                CHECK(p.y() == Approx(-15.3).margin(1e-10));
            } else {
                CHECK(p.z() == Approx(2.2 + 0.034 * (p.y() + 2) * (p.y() + 2)).margin(1e-10));
            }
        }
        CHECK(length > 1.0);
        CHECK(turned < 12.0);  // 2 pi for a convex plane curve; a ragged border turns many times that
        CHECK(triangle_quality(mesh).mean_least_angle > 47.0);
        CHECK(slivers(mesh) < 6);  // of 6000, in the furrow between lid and eyeball, finer than the triangles
    }
}

TEST_CASE("The same options give the same bits, another seed another tessellation", "[sweep]") {
    const Mesh a = neutral_face(), b = make(HeadCrop::Face, 6000, 2), c = make(HeadCrop::Face, 6000, 3);
    CHECK(a.F == b.F);
    REQUIRE(a.V.rows() == b.V.rows());
    CHECK(std::memcmp(a.V.data(), b.V.data(), static_cast<std::size_t>(a.V.size()) * sizeof(double)) == 0);
    CHECK((a.V.rows() != c.V.rows() || a.V != c.V));
    CHECK(triangle_areas(a).sum() == Approx(triangle_areas(c).sum()).epsilon(0.01));
}

TEST_CASE("The head's field is symmetric and its gradient is that of its values") {
    const ImplicitSurface surface = head_surface();
    int compared = 0;
    for (int k = 0; k < 4000; ++k) {
        const Eigen::Vector3d p(0.4 * std::sin(1.0 + 3.0 * k), -0.1 + 0.55 * std::sin(2.0 + 7.1 * k),
                                0.02 + 0.48 * std::sin(5.3 * k));
        const FieldSample f = surface(p);
        if (std::abs(f.value) > 0.03) continue;  // only the surface counts
        ++compared;
        CHECK(surface({-p.x(), p.y(), p.z()}).value == f.value);
        CHECK(f.gradient.norm() > 0.1);
        CHECK(f.gradient.norm() < 3.0);
        for (int axis = 0; axis < 3; ++axis) {
            const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(axis);
            const double difference = (surface(p + step).value - surface(p - step).value) / 2e-6;
            CHECK(f.gradient[axis] == Approx(difference).margin(2e-3));
        }
    }
    CHECK(compared > 200);
}

TEST_CASE("The head's field has no step where parts of the sculpture come into reach") {
    // Halves segments near the surface, always on to the half with the larger difference.
    const ImplicitSurface surface = head_surface();
    Random random(7);
    const auto within = [&](double low, double high) { return low + (high - low) * random.uniform(); };
    int tried = 0;
    while (tried < 4000) {
        const Eigen::Vector3d p(within(-0.4, 0.4), within(-0.8, 0.6), within(-0.5, 0.5));
        double a = surface(p).value;
        if (std::abs(a) > 0.007) continue;
        ++tried;
        Eigen::Vector3d from = p, to = p + Eigen::Vector3d(within(-1, 1), within(-1, 1), within(-1, 1)) / 50;
        double b = surface(to).value;
        for (int k = 0; k < 25; ++k) {
            const Eigen::Vector3d middle = 0.5 * (from + to);
            const double m = surface(middle).value;
            const bool first = std::abs(m - a) > std::abs(b - m);
            (first ? to : from) = middle;
            (first ? b : a) = m;
        }
        CAPTURE(from.transpose());
        CHECK(std::abs(b - a) < 1e-8);
    }
}

TEST_CASE("The proportions are those of a head") {
    const ImplicitSurface surface = head_surface();
    const auto reach = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& direction) {
        double inside = 0.0, outside = 1.0;
        for (int k = 0; k < 50; ++k) {
            const double middle = 0.5 * (inside + outside);
            (surface(from + middle * direction).value > 0.0 ? outside : inside) = middle;
        }
        return inside;
    };
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                          z = Eigen::Vector3d::UnitZ();
    const double crown = reach({0, 0.2, 0}, y) + 0.2, chin = reach({0, -0.4, 0.36}, -y) + 0.4;
    CHECK(crown + chin == Approx(1.0).margin(0.03));
    CHECK(crown == Approx(0.5).margin(0.02));  // the eyes at half height
    const double width = 2.0 * reach({0, 0.2, -0.1}, x);
    CHECK(width > 0.60);
    CHECK(width < 0.72);
    const double length = reach({0, 0.12, 0}, z) + reach({0, 0.12, 0}, -z);
    CHECK(length > 0.78);
    CHECK(length < 0.92);
    // The profile: nose before lips before the furrow under them, chin before the furrow.
    const auto profile = [&](double height) { return reach({0, height, 0.2}, z); };
    CHECK(profile(-0.16) > profile(-0.29) + 0.04);
    CHECK(profile(-0.33) > profile(-0.385) + 0.01);
    CHECK(profile(-0.44) > profile(-0.385) + 0.005);
    CHECK(profile(-0.30) < profile(-0.33));  // lips meet in a line
}

TEST_CASE("No preset and no single parameter folds space") {
    for (const HeadPreset preset : kPresets) {
        CAPTURE(static_cast<int>(preset));
        CHECK(least_determinant(head_parameters(preset), 0.021) > 0.1);
    }
    for (const HeadParameter& each : kHeadParameters) {
        for (const double value : {each.least, each.most}) {
            CAPTURE(each.name, value);
            HeadParameters parameters;
            parameters.*each.member = value;
            CHECK(least_determinant(parameters, 0.035) > 0.1);
        }
    }
}

TEST_CASE("Every parameter moves the face symmetrically, the neutral ones nothing") {
    const Eigen::Vector3d p(0.137, -0.09, 0.33), mirrored(-0.137, -0.09, 0.33);
    CHECK(deform_head({}, p) == p);
    const Mesh& mesh = closed_head();
    for (const HeadParameter& each : kHeadParameters) {
        CAPTURE(each.name);
        HeadParameters parameters;
        parameters.*each.member = each.most;
        double most = 0.0;
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            const Eigen::Vector3d at = mesh.V.row(v);
            most = std::max(most, (deform_head(parameters, at) - at).norm());
        }
        CHECK(most > 0.002);  // the lids' height is 0.04
        const Eigen::Vector3d a = deform_head(parameters, p), b = deform_head(parameters, mirrored);
        CHECK((a - Eigen::Vector3d(-b.x(), b.y(), b.z())).norm() < 1e-15);
    }
}

TEST_CASE("Corresponding points: surface to surface, there and back", "[sweep]") {
    const ImplicitSurface surface = head_surface();
    const HeadParameters asian = head_parameters(HeadPreset::Asian),
                         caucasian = head_parameters(HeadPreset::Caucasian);
    const Mesh a = make(HeadCrop::Face, 6000, 2, HeadPreset::Asian);
    const Points on_caucasian = corresponding_head_points(a.V, asian, caucasian);
    // Back to the neutral head, whose equation is known.
    const Points neutral = corresponding_head_points(on_caucasian, caucasian, {});
    CHECK(farthest({neutral, a.F}, surface) < 1e-12);
    const Points back = corresponding_head_points(on_caucasian, caucasian, asian);
    CHECK((back - a.V).rowwise().norm().maxCoeff() < 1e-12);
    CHECK((on_caucasian - a.V).rowwise().norm().maxCoeff() > 0.01);  // the heads differ
    // The same seed tessellates the same points of the neutral surface: ground truth as a second mesh.
    const Mesh& same = neutral_face();
    REQUIRE(same.vertex_count() == a.vertex_count());
    CHECK((corresponding_head_points(same.V, {}, asian) - a.V).rowwise().norm().maxCoeff() < 1e-12);
}

TEST_CASE("Parameters out of range are refused") {
    for (const double value : {0.5, 2.0, std::nan("")}) {
        HeadParameters parameters;
        parameters.nose_width = value;
        CHECK_THROWS_AS(deform_head(parameters, Eigen::Vector3d::Zero()), InvalidMesh);
    }
}

TEST_CASE("Marching tetrahedra make closed manifolds of any field") {
    MarchingOptions options{Eigen::Vector3d::Constant(-1.35), Eigen::Vector3d::Constant(1.35), 0.1};
    const Mesh sphere =
        marching_tetrahedra([](const Eigen::Vector3d& p) { return unit_sphere(p).value; }, options);
    CHECK(euler_characteristic(connectivity(sphere.F, sphere.vertex_count())) == 2);
    CHECK(signed_volume(sphere) == Approx(4.0 / 3.0 * std::acos(-1.0)).epsilon(0.02));
    // Noise: whatever the signs, connectivity() accepts it and no edge is open.
    const Mesh noise = marching_tetrahedra(
        [](const Eigen::Vector3d& p) {
            const double s = 1e4 * std::sin(1e3 * p.x() + 2e3 * p.y() + 3e3 * p.z());
            return p.cwiseAbs().maxCoeff() > 1.2 ? 1.0 : s - std::floor(s) - 0.5;
        },
        options);
    const Connectivity topology = connectivity(noise.F, noise.vertex_count());
    CHECK(boundary_loops(noise, topology).empty());
    options.high.setConstant(0.9);
    CHECK_THROWS_AS(
        marching_tetrahedra([](const Eigen::Vector3d& p) { return unit_sphere(p).value; }, options),
        SolverFailure);
    CHECK_THROWS_AS(marching_tetrahedra([](const Eigen::Vector3d&) { return 1.0; }, options), SolverFailure);
}

TEST_CASE("Cropping a sphere leaves a cap with its border on the plane") {
    MarchingOptions options{Eigen::Vector3d::Constant(-1.35), Eigen::Vector3d::Constant(1.35), 0.1};
    const Mesh sphere =
        marching_tetrahedra([](const Eigen::Vector3d& p) { return unit_sphere(p).value; }, options);
    const ImplicitSurface plane = [](const Eigen::Vector3d& p) -> FieldSample {
        return {p.z() - 0.31, Eigen::Vector3d::UnitZ()};
    };
    const Mesh cap = crop(sphere, unit_sphere, plane);
    const Connectivity topology = connectivity(cap.F, cap.vertex_count());
    CHECK(euler_characteristic(topology) == 1);
    const auto loops = boundary_loops(cap, topology);
    REQUIRE(loops.size() == 1);
    for (const int v : loops[0]) {
        CHECK(cap.V(v, 2) == Approx(0.31).margin(1e-12));
        CHECK(cap.V.row(v).norm() == Approx(1.0).epsilon(1e-12));
    }
    CHECK(cap.V.col(2).maxCoeff() < 0.31 + 1e-12);
    const ImplicitSurface nowhere = [](const Eigen::Vector3d& p) -> FieldSample {
        return {p.z() + 2.0, Eigen::Vector3d::UnitZ()};
    };
    CHECK_THROWS_AS(crop(sphere, unit_sphere, nowhere), SolverFailure);
}
