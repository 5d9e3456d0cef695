#include <algorithm>
#include <cmath>

#include "morph/maps.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "render/figure/figure.h"
#include "render/figure/mesh_source.h"
#include "tests/catch.h"

using namespace automorph;

// The figures that show no morph: 2, 3 and 4.

namespace {

FigureConfig config(const std::string& name) {
    return load_config(std::string(AUTOMORPH_CONFIGS "/") + name);
}

Figure draft(FigureConfig config) {
    FigureOptions options;
    options.spp = 1;
    options.scale = 0.2;
    return render_figure(config, options);
}

/// Share of pixels that are not paper.
double inked(const render::Image& image) {
    int count = 0;
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) count += image.pixels[i] < 0.9f;
    return 3.0 * count / static_cast<double>(image.pixels.size());
}

}  // namespace

TEST_CASE("figure 2: a face and its map, one-to-one on the whole disk", "[sweep]") {
    const FigureConfig fig2 = config("fig2.yaml");
    const InputMesh face = make_mesh(fig2.source, "face");
    const ShapeMap map = map_shape(face);
    CHECK(map.report.flipped == 0);
    CHECK(map.report.weights == "cotangent");
    CHECK(std::count(map.is_filling.begin(), map.is_filling.end(), 0) == face.mesh.triangle_count());
    REQUIRE(map.rays.rows() == map.mesh.vertex_count());
    for (const int v : map.loop) CHECK(map.rays.row(v).head<2>().norm() == Approx(1.0));
    Points flat = map.rays;
    flat.col(2).setZero();
    const double share = triangle_areas({flat, map.mesh.F}).sum() / 3.14159265;
    CHECK(share > 0.98);
    CHECK(share <= 1.0);

    const Figure figure = draft(fig2);
    REQUIRE(figure.rows.size() == 1);
    REQUIRE(figure.rows[0].cells.size() == 2);
    CHECK(figure.rows[0].cells[1].label == "harmonic map");
    // The disk, less a margin, on a cell of 9 x 10.
    const double disk = 3.14159265 / 4 * std::pow(1 - fig2.picture.margin, 2) * 0.9;
    CHECK(inked(figure.rows[0].cells[1].image) == Approx(disk).margin(0.1));
    REQUIRE(figure.morphs.size() == 1);
    CHECK(figure.morphs[0].maps.size() == 1);
}

TEST_CASE("figure 2 shows a closed shape on the sphere, an opening as a hole", "[sweep]") {
    FigureConfig closed = config("fig2.yaml");
    closed.source.crop = HeadCrop::Closed;
    const Figure figure = draft(closed);
    CHECK(figure.rows[0].cells[1].label == "map onto the sphere");
    CHECK(figure.morphs[0].maps[0].flipped == 0);
    CHECK(inked(figure.rows[0].cells[1].image) > 0.5);
}

TEST_CASE("a shape from several sides: one cell per turn, the camera holds for all") {
    FigureConfig head = config("head.yaml");
    head.source.triangles = 3000;
    head.turns = {0, 90, 360};
    const Figure figure = draft(head);
    REQUIRE(figure.rows.size() == 1);
    const std::vector<FigureCell>& cells = figure.rows[0].cells;
    REQUIRE(cells.size() == 3);
    CHECK(cells[1].label == "90\u00b0");
    CHECK(figure.morphs[0].source.closed);
    // Deeper than wide; a full turn is none, but for noise and rounding at the rim.
    CHECK(inked(cells[1].image) > 1.1 * inked(cells[0].image));
    CHECK(inked(cells[2].image) == Approx(inked(cells[0].image)).epsilon(0.01));
}

TEST_CASE("figure 3: each border gets the vertices of the other", "[sweep]") {
    const FigureConfig fig3 = config("fig3.yaml");
    const InputMesh source = make_mesh(fig3.source, "source"), target = make_mesh(fig3.target, "target");
    const BorderInsertion insertion = insert_borders(source, target, fig3.seed);
    const BorderUnion& border = insertion.border;
    CHECK(border.source_size == insertion.source.rows());
    CHECK(border.size() == border.source_size + border.target_size - border.shared);
    const auto own = [](const std::vector<BorderSite>& sites) {
        return std::count_if(sites.begin(), sites.end(), [](const BorderSite& s) { return s.is_vertex(); });
    };
    CHECK(own(border.source) == border.source_size);
    CHECK(own(border.target) == border.target_size);

    const Figure figure = draft(fig3);
    REQUIRE(figure.rows.size() == 1);
    CHECK(figure.rows[0].cells.size() == 3);
    CHECK(figure.morphs[0].border.merged == border.size());
    CHECK(figure.morphs[0].registration.used);
    for (const FigureCell& cell : figure.rows[0].cells) CHECK(inked(cell.image) > 0.005);

    FigureConfig closed = fig3;
    closed.target.crop = HeadCrop::Closed;
    CHECK_THROWS_AS(draft(closed), InvalidMesh);
}

TEST_CASE("figure 4: features of the second row are where the other face has them", "[sweep]") {
    const FigureConfig fig4 = config("fig4.yaml");
    const InputMesh source = make_mesh(fig4.source, "source"), target = make_mesh(fig4.target, "target");
    const Figure figure = draft(fig4);
    REQUIRE(figure.morphs.size() == 2);
    for (const Report& report : figure.morphs) REQUIRE(report.features.size() == 1);
    const FeatureReport& features = figure.morphs[1].features[0];
    const auto count = static_cast<Eigen::Index>(features.matches.size());
    REQUIRE(count >= 6);
    Points from(count, 3), to(count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
        const FeatureReport::Match& match = features.matches[static_cast<std::size_t>(i)];
        CHECK(std::binary_search(features.candidates_source.begin(), features.candidates_source.end(),
                                 match.source));
        from.row(i) = source.mesh.V.row(match.source);
        to.row(i) = target.mesh.V.row(match.target);
    }
    const Points truth = corresponding_head_points(from, fig4.source.proportions, fig4.target.proportions);
    const Eigen::VectorXd error = (to - truth).rowwise().norm() / bounding_box_diagonal(target.mesh.V);
    INFO("errors: " << error.transpose());
    CHECK(error.mean() < 0.03);
}
