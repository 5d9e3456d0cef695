#include "morph/alignment/nonrigid.h"

#include <tbb/task_arena.h>

#include <Eigen/Geometry>

#include "morph/alignment/places.h"
#include "morph/mesh/geometry.h"
#include "morph/morph.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

/// A smooth motion of some 3 % of the shapes here.
Points warped(const Points& V) {
    Points u(V.rows(), 3);
    u.col(0) = 0.09 * (2.1 * V.col(1).array() + 0.4).sin();
    u.col(1) = 0.09 * (1.7 * V.col(2).array() - 1.3 * V.col(0).array()).sin();
    u.col(2) = 0.07 * (2.3 * V.col(0).array() + 1.1 * V.col(1).array() + 1.0).cos();
    return V + u;
}

/// A lopsided star: no symmetry hides a wrong answer.
Mesh bent_star(std::uint64_t seed) {
    Mesh mesh = star({.arms = 4, .inner = 0.6, .depth = 0.5}, {.triangles = 6000, .seed = seed});
    mesh.V.col(0) *= 1.3;
    mesh.V.col(2).array() += 0.25 * mesh.V.col(0).array().square();
    return mesh;
}

/// The part above a plane: open, one border.
Mesh above(const Mesh& mesh, double z) {
    Mesh part = mesh;
    int kept = 0;
    for (int f = 0; f < mesh.triangle_count(); ++f) {
        if (mesh.V(mesh.F(f, 0), 2) > z && mesh.V(mesh.F(f, 1), 2) > z && mesh.V(mesh.F(f, 2), 2) > z)
            part.F.row(kept++) = mesh.F.row(f);
    }
    part.F.conservativeResize(kept, 3);
    return admit_mesh(part).mesh;
}

/// Mean distance of places from the truth, in percent of the diagonal.
double mean_error(const Mesh& target, const std::vector<SurfacePlace>& places, const Points& truth) {
    double sum = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i)
        sum += (places[i].in(target.V) - truth.row(static_cast<Eigen::Index>(i))).norm();
    return 100.0 * sum / static_cast<double>(places.size()) / bounding_box_diagonal(target.V);
}

}  // namespace

TEST_CASE("a smooth warp of another tessellation is found") {
    const Mesh source = bent_star(1);
    Mesh target = bent_star(2);
    target.V = warped(target.V);
    const Points truth = warped(source.V);
    const double before = mean_error(target, places_on(target, source.V, vertex_normals(source)), truth);
    const NonRigidAlignment alignment = align_nonrigid(source, {}, source.V, target, {});
    const Points normals = vertex_normals({alignment.x, source.F});
    const double after = mean_error(target, places_on(target, alignment.x, normals), truth);
    INFO("before " << before << " %, after " << after << " %");
    CHECK(after < 0.65);
    CHECK(after < 0.3 * before);
    CHECK(alignment.distance < 0.01);
}

TEST_CASE("a shape on itself stays where it is") {
    const Mesh mesh = bent_star(1);
    const NonRigidAlignment alignment = align_nonrigid(mesh, {}, mesh.V, mesh, {});
    CHECK((alignment.x - mesh.V).rowwise().norm().mean() < 2e-3 * bounding_box_diagonal(mesh.V));
}

TEST_CASE("units do not matter, nor does the number of threads", "[sweep]") {
    const Mesh source = bent_star(1);
    Mesh target = bent_star(2);
    target.V = warped(target.V);
    const Points x = align_nonrigid(source, {}, source.V, target, {}).x;
    tbb::task_arena one(1);
    CHECK(one.execute([&] { return align_nonrigid(source, {}, source.V, target, {}).x; }) == x);
    // A power of two changes exponents only.
    const Mesh big_source{1024.0 * source.V, source.F}, big_target{1024.0 * target.V, target.F};
    const Points big = align_nonrigid(big_source, {}, big_source.V, big_target, {}).x;
    CHECK((big / 1024.0 - x).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("the dense alignment of open shapes is one-to-one and far better than the registration alone") {
    const Mesh whole = bent_star(3), other = bent_star(4);
    const Mesh source = above(whole, -0.05);
    Mesh target = above(other, -0.05);
    const Points truth = warped(source.V);
    target.V = warped(target.V);
    double error[2];
    for (const Alignment alignment : {Alignment::Registration, Alignment::Dense}) {
        MorphOptions options;
        options.alignment = alignment;
        const Morph result = morph(admit_mesh(source), admit_mesh(target), options);
        for (const MapReport& map : result.report().maps) CHECK(map.flipped == 0);
        CHECK(result.report().alignment.used == (alignment == Alignment::Dense));
        error[alignment == Alignment::Dense] = 100.0 *
                                               (result.correspondence() - truth).rowwise().norm().mean() /
                                               bounding_box_diagonal(target.V);
    }
    INFO("registration " << error[0] << " %, dense " << error[1] << " %");
    CHECK(error[1] < 0.8);
    CHECK(error[1] < 0.6 * error[0]);
}

TEST_CASE("an open shape is laid densely on a closed one, whichever comes first") {
    const Mesh part = above(bent_star(3), 0.1);
    Mesh whole = bent_star(4);
    whole.V = warped(whole.V);
    const Points truth = warped(part.V);
    double error[2];
    for (const Alignment alignment : {Alignment::Registration, Alignment::Dense}) {
        MorphOptions options;
        options.alignment = alignment;
        const Morph result = morph(admit_mesh(part), admit_mesh(whole), options);
        for (const MapReport& map : result.report().maps) CHECK(map.flipped == 0);
        CHECK(result.report().alignment.used == (alignment == Alignment::Dense));
        error[alignment == Alignment::Dense] = 100.0 *
                                               (result.correspondence() - truth).rowwise().norm().mean() /
                                               bounding_box_diagonal(whole.V);
    }
    INFO("registration " << error[0] << " %, dense " << error[1] << " %");
    CHECK(error[1] < 1.0);
    CHECK(error[1] < 0.9 * error[0]);

    // The other way round the open shape, now the target, is the one that moves.
    const Morph back = morph(admit_mesh(whole), admit_mesh(part), {});
    CHECK(back.report().alignment.used);
    CHECK(back.report().maps[1].weights == "dense alignment");
    CHECK(back.report().maps[1].flipped == 0);
}
