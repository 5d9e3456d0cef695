#include "morph/registration/registration.h"

#include <tbb/global_control.h>

#include <Eigen/LU>
#include <algorithm>
#include <utility>
#include <vector>

#include "morph/registration/denoise.h"
#include "morph/registration/procrustes.h"
#include "tests/catch.h"
#include "tests/morph/registration/shapes.h"

using namespace automorph;

namespace {

// A known similarity of arbitrary turn.
struct Pose {
    Eigen::Matrix3d R;
    Eigen::Vector3d t;
    double scale;

    explicit Pose(test::Random& random)
        : R(random.rotation()), t(5.0 * random.normal3()), scale(std::exp(2.0 * random.normal())) {}

    Mesh of(const Mesh& mesh) const { return test::moved(mesh, R, t, scale); }
};

struct Errors {
    double degrees = 0.0, scale = 0.0, place = 0.0;  // place: of vertices, relative to the target's diagonal

    Errors(const Registration& found, const Pose& truth, const Mesh& mesh)
        : degrees(test::degrees(rotation_angle(found.R * truth.R.transpose()))),
          scale(std::abs(found.scale / truth.scale - 1.0)) {
        const Points expected = truth.of(mesh).V;
        place =
            (found.apply(mesh.V) - expected).rowwise().norm().maxCoeff() / bounding_box_diagonal(expected);
    }
};

// How far off the worst of many random poses is; each pose has its own seed.
struct Worst {
    double degrees = 0.0, scale = 0.0, place = 0.0;
    int unsure = 0;
};

Worst worst_of(const Mesh& source, const Mesh& same_shape, int poses, std::uint64_t seed,
               double noise = 0.0) {
    Worst worst;
    test::Random random(seed);
    for (int trial = 0; trial < poses; ++trial) {
        const Pose truth(random);
        const Mesh a = noise > 0.0 ? test::with_noise(source, noise, random) : source;
        const Mesh b = truth.of(noise > 0.0 ? test::with_noise(same_shape, noise, random) : same_shape);
        const Registration found = register_rigid(a, b, {.seed = seed + static_cast<std::uint64_t>(trial)});
        const Errors errors(found, truth, source);
        worst.degrees = std::max(worst.degrees, errors.degrees);
        worst.scale = std::max(worst.scale, errors.scale);
        worst.place = std::max(worst.place, errors.place);
        worst.unsure += found.confident ? 0 : 1;
    }
    return worst;
}

}  // namespace

TEST_CASE("a differently tessellated copy is found again from 500 random rotations, at any scale",
          "[sweep]") {
    struct Case {
        Mesh source, target;
        int poses;
    };
    const Eigen::Vector3d stretch(1.3, 1.0, 0.7);
    const Mesh fine = test::icosphere(3), rings = test::ring_sphere(20, 32);
    const std::vector<Case> cases = {
        {test::with_bumps(fine, 0.4), test::with_bumps(rings, 0.4), 100},
        {test::with_bumps(fine, 0.2), test::with_bumps(rings, 0.2), 100},
        {test::stretched(test::with_bumps(fine, 0.3), stretch),
         test::stretched(test::with_bumps(rings, 0.3), stretch), 100},
        {test::stretched(test::with_bumps(rings, 0.1), stretch),
         test::stretched(test::with_bumps(fine, 0.1), stretch), 100},
        {test::cropped(test::with_bumps(fine, 0.4), Eigen::Vector3d::UnitZ(), -0.2),
         test::cropped(test::with_bumps(test::icosphere(4), 0.4), Eigen::Vector3d::UnitZ(), -0.2), 100}};
    std::uint64_t seed = 1;
    for (const Case& c : cases) {
        const Worst worst = worst_of(c.source, c.target, c.poses, seed += 1000);
        CAPTURE(seed, worst.degrees, worst.scale, worst.place);
        CHECK(worst.degrees <
              5.0);  // the usual bound of success; coarse tessellations differ by more than a degree
        CHECK(worst.scale < 0.02);
        CHECK(worst.place < 0.02);
        CHECK(worst.unsure == 0);
    }
}

TEST_CASE("real shapes are found again in another tessellation", "[sweep]") {
    for (const std::string name :
         {"nefertiti", "head", "hand", "triceratops", "homer", "lion-head", "mannequin-devil"}) {
        const Mesh mesh = test::demo_mesh(name);
        if (mesh.vertex_count() == 0) {
            WARN("no " << name << ".off in " << AUTOMORPH_DEMO_MESHES << ": not tested");
            return;
        }
        const Worst worst = worst_of(mesh, test::re_tessellated(mesh), 4, 40);
        CAPTURE(name, worst.degrees, worst.scale, worst.place);
        CHECK(worst.degrees < 0.5);
        CHECK(worst.scale < 0.02);
        CHECK(worst.unsure == 0);
    }
}

TEST_CASE("shapes that differ settle in one place, soon", "[sweep]") {
    for (const auto& [a, b] : {std::pair("cow", "bull"), std::pair("mannequin-devil", "lion-head")}) {
        const Mesh source = test::demo_mesh(a), target = test::demo_mesh(b);
        if (source.vertex_count() == 0 || target.vertex_count() == 0) {
            WARN("no " << a << ".off or " << b << ".off in " << AUTOMORPH_DEMO_MESHES << ": not tested");
            return;
        }
        const Registration found = register_rigid(source, target);
        CAPTURE(a, b, found.iterations);
        CHECK(found.converged);
        CHECK(found.iterations < 80);
        const Registration longer = register_rigid(source, target, {.max_iterations = 400});
        CHECK(test::degrees(rotation_angle(found.R * longer.R.transpose())) < 0.1);
    }
}

TEST_CASE("noise of 1 and 3 percent of the diagonal on both meshes is borne", "[sweep]") {
    for (const std::string name : {"head", "hand", "lion-head"}) {
        const Mesh mesh = test::demo_mesh(name);
        if (mesh.vertex_count() == 0) {
            WARN("no " << name << ".off in " << AUTOMORPH_DEMO_MESHES << ": not tested");
            return;
        }
        const Mesh other = test::re_tessellated(mesh);
        CAPTURE(name);
        CHECK(worst_of(mesh, other, 3, 60, 0.01).degrees < 2.0);
        CHECK(worst_of(mesh, other, 3, 70, 0.03).degrees < 5.0);
    }
}

TEST_CASE("noise is recognised on the surface and sharp edges are not taken for it") {
    test::Random random(6);
    const Mesh smooth = test::with_bumps(test::icosphere(4), 0.4);
    CHECK(crumpling(smooth) < 0.04);
    CHECK_FALSE(denoised(smooth).has_value());
    const Mesh noisy = test::with_noise(smooth, 0.02, random);
    CHECK(crumpling(noisy) > 0.35);
    REQUIRE(denoised(noisy).has_value());
    CHECK(crumpling(*denoised(noisy)) < 0.1);
    // Nearer to the true surface than the noise was.
    CHECK((denoised(noisy)->V - smooth.V).norm() < 0.5 * (noisy.V - smooth.V).norm());
    for (const std::string name : {"fandisk", "oblong"}) {
        const Mesh part = test::demo_mesh(name);
        if (part.vertex_count() == 0) return;
        CAPTURE(name);
        CHECK_FALSE(denoised(part).has_value());
    }
}

TEST_CASE("a pose that symmetry leaves open is reported as not confident") {
    test::Random random(7);
    const Pose pose(random);
    const auto confident = [&](const Mesh& a, const Mesh& b) {
        return register_rigid(a, pose.of(b)).confident;
    };
    const Mesh fine = test::icosphere(3), rings = test::ring_sphere(20, 32);
    const Eigen::Vector3d revolution(1.5, 1, 1), triaxial(1.5, 1, 0.6);
    CHECK_FALSE(confident(fine, rings));
    CHECK_FALSE(confident(test::stretched(fine, revolution), test::stretched(rings, revolution)));
    CHECK_FALSE(confident(test::stretched(fine, triaxial), test::stretched(rings, triaxial)));
    const Mesh bumps = test::stretched(test::with_bumps(fine, 0.3), triaxial);
    CHECK(confident(bumps, test::stretched(test::with_bumps(rings, 0.3), triaxial)));
}

TEST_CASE("of equally good poses the one that turns least is taken") {
    const Eigen::Vector3d triaxial(1.5, 1, 0.6);  // four poses fit
    const Mesh a = test::stretched(test::icosphere(3), triaxial);
    const Mesh b = test::stretched(test::ring_sphere(20, 32), triaxial);
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const Registration found = register_rigid(a, test::moved(b, turn, {1, 2, 3}, 1.0));
    CHECK(test::degrees(rotation_angle(found.R * turn.transpose())) < 1.0);
}

TEST_CASE("an open mesh that faces the other way is registered all the same") {
    test::Random random(8);
    const Mesh shape = test::with_bumps(test::icosphere(4), 0.4);
    const Mesh a = test::cropped(shape, Eigen::Vector3d::UnitX(), 0.3);
    const Mesh b = test::reversed(test::re_tessellated(a));
    for (int trial = 0; trial < 5; ++trial) {
        const Pose pose(random);
        const Errors errors(register_rigid(a, pose.of(b)), pose, a);
        CHECK(errors.degrees < 1.0);
    }
}

TEST_CASE("front and back of a flat shape are told apart by normals") {
    // A thin lens, one side hardly rounder than the other, with a bump at the rim: turned over by the axis
    // through the bump it has nearly the same points, but for its normals and a little depth.
    Mesh lens = test::with_bumps(test::icosphere(3), 0.3);
    Mesh other = test::with_bumps(test::ring_sphere(20, 32), 0.3);
    lens = test::stretched(lens, {1, 1, 0.15});
    other = test::stretched(other, {1, 1, 0.15});
    const Worst worst = worst_of(lens, other, 10, 90);
    CAPTURE(worst.degrees);
    CHECK(worst.degrees < 5.0);
}

TEST_CASE("different crops of one shape still find their pose") {
    test::Random random(9);
    const Mesh shape = test::with_bumps(test::icosphere(4), 0.4);
    const Mesh a = test::cropped(shape, Eigen::Vector3d(1, 0, 0.1), -0.2);
    const Mesh b = test::re_tessellated(test::cropped(shape, Eigen::Vector3d(1, 0.1, 0), -0.3));
    for (int trial = 0; trial < 5; ++trial) {
        const Pose pose(random);
        const Registration found = register_rigid(a, pose.of(b));
        CHECK(test::degrees(rotation_angle(found.R * pose.R.transpose())) < 5.0);
    }
}

TEST_CASE("a shape of which the other has only a part is found at its own size", "[sweep]") {
    test::Random random(13);
    const Mesh whole = test::stretched(test::with_bumps(test::icosphere(4), 0.4), {1.3, 1.0, 0.7});
    const Mesh part = test::re_tessellated(test::cropped(whole, Eigen::Vector3d(1, 0.1, 0.3), -0.6));
    for (int trial = 0; trial < 3; ++trial) {
        const Pose pose(random);
        for (const bool backwards : {false, true}) {
            const Registration found =
                backwards ? register_rigid(part, pose.of(whole)) : register_rigid(whole, pose.of(part));
            CAPTURE(backwards, found.scale / pose.scale);
            const bool right = test::degrees(rotation_angle(found.R * pose.R.transpose())) < 5.0;
            CHECK((right || !found.confident));
            if (!backwards) CHECK(right);
            // By the sizes alone it would be 10 % off.
            if (right) CHECK(std::abs(found.scale / pose.scale - 1.0) < 0.02);
        }
    }
}

TEST_CASE("a re-posed copy is laid exactly on its vertices, in any order") {
    test::Random random(10);
    const Mesh a = test::with_bumps(test::icosphere(3), 0.4);
    const Pose pose(random);
    Mesh b = pose.of(a);
    b.V = b.V.colwise().reverse().eval();
    b.F = (a.vertex_count() - 1 - b.F.array()).matrix().eval();
    const Registration found = register_rigid(a, b);
    const Errors errors(found, pose, a);
    CHECK(errors.degrees < 1e-6);
    CHECK(errors.place < 1e-9);
    CHECK(found.sigma < 1e-9 * bounding_box_diagonal(b.V));
}

TEST_CASE("sigma is Eq. (7) over the vertices at the pose found") {
    test::Random random(11);
    const Mesh a = test::with_bumps(test::icosphere(3), 0.4);
    const Mesh b = Pose(random).of(test::with_bumps(test::ring_sphere(20, 32), 0.4));
    const Registration found = register_rigid(a, b);
    const Points y = found.apply(a.V);
    double sum = 0.0;
    for (int i = 0; i < y.rows(); ++i)
        sum += std::sqrt((b.V.rowwise() - y.row(i)).rowwise().squaredNorm().minCoeff());
    CHECK(found.sigma == Approx(sum / static_cast<double>(y.rows())).epsilon(1e-9));
    CHECK(found.converged);
    CHECK(found.R.determinant() == Approx(1.0));
}

TEST_CASE("the same seed gives the same bits for any number of threads") {
    test::Random random(12);
    const Mesh a = test::with_bumps(test::icosphere(3), 0.3);
    const Mesh b = Pose(random).of(test::with_bumps(test::ring_sphere(20, 32), 0.3));
    std::vector<Registration> found;
    for (const std::size_t threads : {1, 2, 3, 8}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        found.push_back(register_rigid(a, b));
    }
    for (const Registration& other : found) {
        CHECK(other.R == found[0].R);
        CHECK(other.t == found[0].t);
        CHECK(other.sigma == found[0].sigma);
        CHECK(other.residual == found[0].residual);
        CHECK(other.runner_up == found[0].runner_up);
        CHECK(other.iterations == found[0].iterations);
    }
}

TEST_CASE("meshes of a few triangles are registered without fault") {
    Mesh triangle{Points(3, 3), Triangles(1, 3)};
    triangle.V << 0, 0, 0, 3, 0, 0, 0, 1, 0;
    triangle.F << 0, 1, 2;
    const Registration found = register_rigid(triangle, triangle);
    CHECK(found.R.allFinite());
    CHECK(found.R.determinant() == Approx(1.0));
    CHECK(found.scale == Approx(1.0));
    CHECK(found.residual < 0.05);
}
