#include "render/figure/color_field.h"

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "morph/shapes/shapes.h"
#include "tests/catch.h"

using namespace automorph;

namespace {

FrameSequence sequence_of(const Mesh& mesh, const std::vector<Points>& frames) {
    FrameSequence sequence;
    sequence.triangles = mesh.F;
    sequence.source = mesh.V;
    sequence.frames = frames;
    sequence.alphas.resize(frames.size());
    return sequence;
}

Points moved(const Points& V, const Eigen::Matrix3d& linear) {
    return (V * linear.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2);
}

const Eigen::Matrix3d kTurn =
    Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();

}  // namespace

TEST_CASE("a rigid motion displaces and distorts nothing; a scaling does by what it is") {
    const Mesh sphere = ellipsoid({1, 1, 1}, {.triangles = 2000});
    const FrameSequence sequence =
        sequence_of(sphere, {sphere.V, moved(sphere.V, kTurn), moved(sphere.V, 2 * kTurn)});
    const auto displacement = color_field(ColorField::Displacement, sequence);
    REQUIRE(displacement.size() == 3);
    CHECK(displacement[0].maxCoeff() < 1e-9);
    CHECK(displacement[1].maxCoeff() < 1e-9);
    CHECK(displacement[2].minCoeff() == Approx(1).epsilon(0.01));  // from radius 1 to 2
    CHECK(displacement[2].maxCoeff() == Approx(1).epsilon(0.01));
    const auto distortion = color_field(ColorField::Distortion, sequence);
    for (int i = 0; i < 3; ++i) {
        CHECK(distortion[static_cast<std::size_t>(i)].minCoeff() == Approx(i < 2 ? 1 : 2));
        CHECK(distortion[static_cast<std::size_t>(i)].maxCoeff() == Approx(i < 2 ? 1 : 2));
    }
}

TEST_CASE("distortion is the larger of stretch and shrinkage") {
    // A flat grid, stretched along x and shrunk along y.
    Mesh grid{Points(4, 3), Triangles(2, 3)};
    grid.V << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
    grid.F << 0, 1, 2, 0, 2, 3;
    const auto values = [&](double x, double y) {
        const Eigen::Vector3d scale(x, y, 1);
        return color_field(ColorField::Distortion,
                           sequence_of(grid, {moved(grid.V, kTurn * scale.asDiagonal())}))[0];
    };
    CHECK(values(1.5, 0.8).maxCoeff() == Approx(1.5));
    CHECK(values(1.5, 0.8).minCoeff() == Approx(1.5));
    CHECK(values(1.5, 0.25).maxCoeff() == Approx(4));
    CHECK(values(1, 0).maxCoeff() == Approx(100));  // collapsed: the limit, not infinity
}

TEST_CASE("the curvature of a sphere is what its legend says, whatever its size") {
    for (const double size : {0.01, 1.0, 50.0}) {
        const Mesh sphere = ellipsoid({size, size, size}, {.triangles = 8000});
        const auto values = color_field(ColorField::Curvature, sequence_of(sphere, {sphere.V}));
        CHECK(values[0].mean() == Approx(std::sqrt(4 * 3.14159265)).epsilon(0.03));
        CHECK(values[0].minCoeff() > 3.0);
        CHECK(values[0].maxCoeff() < 4.1);
    }
}

TEST_CASE("a border has the curvature of what is beside it") {
    const Mesh bowl = ellipsoid({1, 1, 1}, {.triangles = 4000}, 0.4);
    const auto values = color_field(ColorField::Curvature, sequence_of(bowl, {bowl.V}));
    CHECK(values[0].allFinite());
    CHECK(values[0].minCoeff() > 0.7 * values[0].mean());
    CHECK(values[0].maxCoeff() < 1.3 * values[0].mean());
}

TEST_CASE("vertices without an area of note, as an overlay has them, do not show in the curvature") {
    // In every twentieth triangle a tiny one with a vertex in its middle, bent as rounding has it.
    constexpr double kTiny = 1e-12;
    Mesh sphere = ellipsoid({1, 1, 1}, {.triangles = 4000});
    std::vector<Eigen::RowVector3d> points(sphere.V.rowwise().begin(), sphere.V.rowwise().end());
    std::vector<Eigen::RowVector3i> faces;
    for (Eigen::Index f = 0; f < sphere.F.rows(); ++f) {
        const Eigen::RowVector3i t = sphere.F.row(f);
        if (f % 20 != 0) {
            faces.push_back(t);
            continue;
        }
        const Eigen::RowVector3d middle = sphere.V(t, Eigen::all).colwise().mean();
        const int p = static_cast<int>(points.size());  // the tiny triangle is p, p + 1, p + 2
        for (const int corner : t) points.push_back(middle + kTiny * (sphere.V.row(corner) - middle));
        points.push_back(middle * (1 + kTiny));
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            faces.insert(faces.end(),
                         {{t[k], t[next], p + k}, {t[next], p + next, p + k}, {p + k, p + next, p + 3}});
        }
    }
    sphere.V.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i) sphere.V.row(static_cast<Eigen::Index>(i)) = points[i];
    sphere.F.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t i = 0; i < faces.size(); ++i) sphere.F.row(static_cast<Eigen::Index>(i)) = faces[i];

    const auto values = color_field(ColorField::Curvature, sequence_of(sphere, {sphere.V}));
    CHECK(values[0].minCoeff() > 3.0);
    CHECK(values[0].maxCoeff() < 4.1);
}

TEST_CASE("one scale holds for all rows, leaves out the extremes and is rounded") {
    const Eigen::VectorXd small = Eigen::VectorXd::LinSpaced(101, 0, 0.5);
    Eigen::VectorXd large = Eigen::VectorXd::LinSpaced(101, 0, 1.2345);
    large[100] = 1e9;
    large[3] = std::nan("");
    const ColorScale scale = color_scale(ColorField::Displacement, {{small}, {large, small}});
    CHECK(scale.low == 0);
    CHECK(scale.high == Approx(1.1));
    CHECK(scale.meaning.find("scene units") != std::string::npos);
    CHECK(color_scale(ColorField::Distortion, {{small}}).low == 1);
    const ColorScale signed_scale = color_scale(ColorField::Curvature, {{-small}});
    CHECK(signed_scale.low == Approx(-0.49));
    CHECK(signed_scale.high >= signed_scale.low);
    CHECK(color_scale(ColorField::Displacement, {{Eigen::VectorXd::Zero(5)}}).high == 0);
}
