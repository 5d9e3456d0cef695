#include "morph/parameterization/border_control.h"

#include <Eigen/Geometry>
#include <random>

#include "morph/mesh/connectivity.h"
#include "morph/parameterization/border.h"
#include "tests/catch.h"
#include "tests/morph/parameterization/disks.h"

using namespace automorph;

namespace {

/// A dome with an oval border, no symmetry left.
Mesh oval(int rings) {
    Mesh mesh = disks::dome(rings, 0.6);
    for (int v = 0; v < mesh.vertex_count(); ++v) {
        const double x = mesh.V(v, 0), y = mesh.V(v, 1);
        mesh.V(v, 0) = 1.7 * x + 0.2 * y * y;
        mesh.V(v, 1) = y + 0.25 * x * x;
        mesh.V(v, 2) += 0.3 * x;
    }
    return mesh;
}

/// A known motion, as registration would find it, with the given sigma in target units.
Registration motion(double sigma) {
    Registration r;
    r.R = Eigen::AngleAxisd(2.2, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    r.t = Eigen::Vector3d(3, -1, 10);
    r.scale = 2.5;
    r.sigma = sigma;
    return r;
}

}  // namespace

TEST_CASE("the control pair of a shape and its moved copy is the same vertex, run the same way") {
    const Mesh source = oval(10);
    const std::vector<int> loop = disks::border_of(source);
    for (const double sigma : {1e-3, 0.02, 0.2}) {
        const Registration registration = motion(sigma);
        auto [target, new_index] = disks::renumbered(source, 7);
        target.V = registration.apply(target.V);
        const std::vector<int> target_loop = disks::border_of(target);
        const BorderControl control = registered_control(source, loop, target, target_loop, registration);
        INFO("sigma " << sigma);
        CHECK_FALSE(control.target_reversed);
        CHECK(control.convolution > control.convolution_reversed);
        CHECK(control.responsibility > 0.0);
        CHECK(control.responsibility <= 1.0);
        if (sigma < 0.1) {
            CHECK(new_index[static_cast<std::size_t>(loop[static_cast<std::size_t>(control.source)])] ==
                  target_loop[static_cast<std::size_t>(control.target)]);
        }
    }
}

TEST_CASE("C of the right direction is the mean square distance of the border from the centre") {
    // Eq. (8) of a shape with itself: v_a = v_b at every border point, up to the registration's scale.
    Mesh source = disks::flat(6);
    Registration registration = motion(1e-3);
    Mesh target = source;
    target.V = registration.apply(target.V);
    const BorderControl control =
        registered_control(source, disks::border_of(source), target, disks::border_of(target), registration);
    CHECK(control.convolution == Approx(2.5 * 2.5).epsilon(1e-9));  // radius 1, scale 2.5
    CHECK(control.responsibility > 0.99);
}

TEST_CASE("a target whose triangles face the other way is detected and turned round") {
    const Mesh source = oval(9);
    const std::vector<int> loop = disks::border_of(source);
    const Registration registration = motion(0.01);
    Mesh target = oval(11);  // another tessellation
    target.V = registration.apply(target.V);
    const BorderControl straight =
        registered_control(source, loop, target, disks::border_of(target), registration);
    CHECK_FALSE(straight.target_reversed);

    Mesh inside_out = target;
    inside_out.F.col(0).swap(inside_out.F.col(1));
    const std::vector<int> other_loop = disks::border_of(inside_out);
    const BorderControl control = registered_control(source, loop, inside_out, other_loop, registration);
    CHECK(control.target_reversed);
    CHECK(control.convolution > control.convolution_reversed);
    CHECK(control.convolution == Approx(straight.convolution).epsilon(1e-9));

    const ReversedTarget reversed = reversed_target(inside_out, other_loop, control);
    CHECK_FALSE(reversed.control.target_reversed);
    CHECK(reversed.loop[static_cast<std::size_t>(reversed.control.target)] ==
          other_loop[static_cast<std::size_t>(control.target)]);
    const CommonBorder border = common_border(source, loop, reversed.mesh, reversed.loop, reversed.control);
    // Corresponding border points are near each other in the target's frame.
    const Points moved = registration.apply(border.source.mesh.V);
    double worst = 0.0;
    for (std::size_t k = 0; k < border.source.loop.size(); ++k) {
        worst = std::max(
            worst,
            (moved.row(border.source.loop[k]) - border.target.mesh.V.row(border.target.loop[k])).norm());
    }
    CHECK(worst < 0.3);  // the border is about 20 long
}

TEST_CASE("borders out of each other's reach are tied at their nearest pair") {
    // The target's border lies far beyond a dense disk: none of its vertices is among the nearest of the
    // source's.
    const Mesh source = disks::flat(4);
    Mesh target = disks::flat(40);
    for (const int v : disks::border_of(target)) target.V.row(v) *= 3.0;
    target.V.rowwise() += Eigen::RowVector3d(0.05, 0.02, 0.0);
    Registration registration;
    registration.sigma = 1e-3;
    const std::vector<int> loop = disks::border_of(source), target_loop = disks::border_of(target);
    const BorderControl control = registered_control(source, loop, target, target_loop, registration);
    double nearest = 1e9;
    for (const int i : loop) {
        for (const int j : target_loop)
            nearest = std::min(nearest, (source.V.row(i) - target.V.row(j)).norm());
    }
    CHECK(control.responsibility == 0.0);
    CHECK((source.V.row(loop[static_cast<std::size_t>(control.source)]) -
           target.V.row(target_loop[static_cast<std::size_t>(control.target)]))
              .norm() == Approx(nearest).epsilon(1e-12));
}
