#include "morph/frame_check.h"
#include "morph/mesh/geometry.h"
#include "render/figure/config.h"
#include "render/figure/mesh_source.h"
#include "tests/catch.h"

using namespace automorph;

TEST_CASE("figure 7: Section 3 alone loses volume halfway, the registered morph keeps it") {
    const FigureConfig config = load_config(AUTOMORPH_CONFIGS "/fig7.yaml");
    const InputMesh source = make_mesh(config.source, "ellipsoid"), target = make_mesh(config.target, "star");
    const double whole = (signed_volume(source.mesh) + signed_volume(target.mesh)) / 2;
    REQUIRE(config.rows.size() == 2);
    double halfway[2];
    for (std::size_t i = 0; i < 2; ++i) {
        const RowConfig& row = config.rows[i];
        const Morph m = morph(source, target, row.morph_options(config.seed));
        // The ends are the shapes: lifting moves merged vertices off the facets by less than a per cent of
        // the volume.
        CHECK(signed_volume(m.mesh(0, row.interpolation)) ==
              Approx(signed_volume(source.mesh)).epsilon(0.01));
        CHECK(signed_volume(m.mesh(1, row.interpolation)) ==
              Approx(signed_volume(target.mesh)).epsilon(0.01));
        // What is wrong with the first row the user is told, and nothing about the second.
        const Report report = report_with_frames(m, row.interpolation);
        CHECK((report.notes.size() > m.report().notes.size()) == (i == 0));
        for (const FrameReport& frame : report.frames) {
            if (i == 0) continue;
            CHECK(frame.reversed == 0);
            CHECK(frame.self_intersecting == 0);
        }
        halfway[i] = signed_volume(m.mesh(0.5, row.interpolation)) / whole;
    }
    INFO("volume at 1/2 over the mean of the ends: " << halfway[0] << " and " << halfway[1]);
    CHECK(halfway[0] < 0.6);
    CHECK(halfway[1] > 0.8);
}
