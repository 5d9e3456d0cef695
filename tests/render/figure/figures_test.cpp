#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "morph/frame_check.h"
#include "morph/mesh/geometry.h"
#include "morph/shapes/head.h"
#include "render/figure/config.h"
#include "render/figure/mesh_source.h"
#include "tests/catch.h"

using namespace automorph;

// What the eye sees in the figures, in numbers. Meshes are coarser where that changes nothing of it; where
// the row without registration is looked at, they are the config's own: what it does depends on where their
// borders begin.

namespace {

struct MadeFigure {
    FigureConfig config;
    InputMesh source, target;
    std::vector<Morph> rows;

    explicit MadeFigure(const std::string& name, std::optional<int> triangles = std::nullopt)
        : config(load_config(std::string(AUTOMORPH_CONFIGS "/") + name)) {
        if (triangles) config.source.triangles = config.target.triangles = *triangles;
        source = make_mesh(config.source, "source");
        target = make_mesh(config.target, "target");
        for (const RowConfig& row : config.rows)
            rows.push_back(morph(source, target, row.morph_options(config.seed)));
    }

    /// What the user is told to look at in a row's frames.
    std::vector<std::string> suspicions(std::size_t row) const {
        const Report report = report_with_frames(rows[row], config.rows[row].interpolation);
        return {report.notes.begin() + static_cast<std::ptrdiff_t>(rows[row].report().notes.size()),
                report.notes.end()};
    }

    Mesh halfway(std::size_t row) const { return rows[row].mesh(0.5, config.rows[row].interpolation); }
};

/// How far the edges of the merged mesh are from the mean of their lengths at the ends, relative to it: the
/// mean over all, weighted by length.
double edge_distortion(const Morph& morph, const Mesh& halfway) {
    const Points a = morph.frame(0), b = morph.frame(1);
    double difference = 0.0, total = 0.0;
    for (Eigen::Index f = 0; f < halfway.F.rows(); ++f) {
        for (int k = 0; k < 3; ++k) {
            const int i = halfway.F(f, k), j = halfway.F(f, (k + 1) % 3);
            const double mean = 0.5 * ((a.row(i) - a.row(j)).norm() + (b.row(i) - b.row(j)).norm());
            difference += std::abs((halfway.V.row(i) - halfway.V.row(j)).norm() - mean);
            total += mean;
        }
    }
    return difference / total;
}

/// Mean distance between where a row takes the vertices in front of the face and where they belong, in
/// percent of the target's diagonal.
double mean_error(const MadeFigure& figure, std::size_t row) {
    const auto unposed = [](const MeshConfig& mesh, const Points& points) -> Points {
        return ((points.rowwise() - mesh.translation.transpose()) * rotation_matrix(mesh.rotation)) /
               mesh.scale;
    };
    const Points truth =
        corresponding_head_points(unposed(figure.config.source, figure.source.mesh.V),
                                  figure.config.source.proportions, figure.config.target.proportions);
    const Points found = unposed(figure.config.target, figure.rows[row].correspondence());
    return 100.0 * (found - truth).rowwise().norm().mean() / bounding_box_diagonal(truth);
}

}  // namespace

TEST_CASE("figure 1: linear rows lose the head's proportions on the way, slerp rows keep them", "[sweep]") {
    const MadeFigure figure("fig1.yaml", 5000);
    REQUIRE(figure.rows.size() == 5);
    for (const std::size_t linear : {1, 2})
        CHECK(edge_distortion(figure.rows[linear], figure.halfway(linear)) > 0.12);
    for (const std::size_t slerp : {3, 4})
        CHECK(edge_distortion(figure.rows[slerp], figure.halfway(slerp)) < 0.05);
    // Section 3 alone collapses.
    const double ends =
        0.5 * (bounding_box_diagonal(figure.source.mesh.V) + bounding_box_diagonal(figure.target.mesh.V));
    CHECK(bounding_box_diagonal(figure.halfway(0).V) < 0.75 * ends);
    CHECK(bounding_box_diagonal(figure.halfway(4).V) > 0.9 * ends);
    CHECK_FALSE(figure.suspicions(0).empty());
    CHECK(figure.suspicions(4).empty());
}

TEST_CASE("figure 5: features slide without guidance and are in place in the last row", "[sweep]") {
    const MadeFigure figure("fig5.yaml", 5000);
    REQUIRE(figure.rows.size() == 4);
    const double alone = mean_error(figure, 0), registered = mean_error(figure, 1),
                 dense = mean_error(figure, 3);
    INFO("mean errors: " << alone << ", " << registered << ", " << dense << " %");
    CHECK(alone > 2.0);
    CHECK(registered > 2.0 * dense);
    CHECK(dense < 1.5);
    CHECK(figure.suspicions(3).empty());
}

TEST_CASE("figure 6: an asian face's features are those of the caucasian one in the last row", "[sweep]") {
    const MadeFigure figure("fig6.yaml");
    REQUIRE(figure.rows.size() == 3);
    const double alone = mean_error(figure, 0), dense = mean_error(figure, 2);
    INFO("mean errors: " << alone << ", " << dense << " %");
    CHECK(alone > 3.0 * dense);
    CHECK(dense < 0.8);
    CHECK(figure.suspicions(2).empty());
}

TEST_CASE("figure 8: Section 3 alone collapses, the registered morph keeps its extent", "[sweep]") {
    const MadeFigure figure("fig8.yaml");
    REQUIRE(figure.rows.size() == 2);
    const double ends =
        0.5 * (triangle_areas(figure.source.mesh).sum() + triangle_areas(figure.target.mesh).sum());
    CHECK(triangle_areas(figure.halfway(0)).sum() < 0.5 * ends);
    CHECK(triangle_areas(figure.halfway(1)).sum() > 0.75 * ends);
    CHECK_FALSE(figure.suspicions(0).empty());
    CHECK(figure.suspicions(1).empty());
}
