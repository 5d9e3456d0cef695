#include "render/figure/loops.h"

#include <functional>

#include "render/figure/row_subject.h"
#include "tests/catch.h"
#include "tests/render/blur.h"

using namespace automorph;

namespace {

using Blocks = std::vector<std::vector<double>>;

const char* const kBlurred = R"(source: {shape: ellipsoid, semi_axes: [1, 0.8, 0.5], triangles: 200, seed: 3}
target: {shape: star, triangles: 300}
rows: [{label: plain, alignment: none}]
alphas: [0, 1]
picture: {width: 48, height: 36, spp: 8, markers: {kind: spread, count: 3, radius: 0.08}}
video: {frames: 6, turntable: 12, shutter: 0.8}
)";

/// Pictures of a frame with the shutter open, and of moments while it is.
struct Blur {
    Blocks blurred, middle, sharp;
};

Blur blur_of(const FigureConfig& config, const FigureRow& row, const FilmLoop& loop, int index,
             const std::function<Points(double)>& at, const std::function<Points(double)>& shading_at) {
    constexpr int kSharp = 4;
    const FigureOptions options;
    ShootingPlan plan(config.picture, options, {48, 36, 8});
    for (const Points& V : loop.exposure(index)) plan.add(V);
    Shooting open = plan.shooting();
    open.time_steps = loop.time_steps();
    const Shooting closed = plan.shooting();
    RowSubject moving(open, row, {}), still(closed, row, {});
    std::uint32_t noise = 0;
    moving.correct_normals(loop.shading(index));
    const auto picture = [&](double frame) {
        still.correct_normals({shading_at(frame)});
        return render::block_means(still.shoot({at(frame)}, {}, {}, noise++).image);
    };
    Blur blur;
    for (int pair = 0; pair < render::kBlurPairs; ++pair) {
        blur.blurred.push_back(
            render::block_means(moving.shoot(loop.exposure(index), {}, {}, noise++).image));
        blur.middle.push_back(picture(index));
        std::vector<double>& mean = blur.sharp.emplace_back(blur.middle.back().size(), 0.0);
        for (int k = 0; k < kSharp; ++k) {
            const double time = index + config.video.shutter * render::sharp_moment(pair, k, kSharp);
            const std::vector<double> one = picture(time);
            for (std::size_t i = 0; i < one.size(); ++i) mean[i] += one[i] / kSharp;
        }
    }
    return blur;
}

}  // namespace

TEST_CASE("a loop goes from the source to the target and back, slowly at both, without a seam") {
    for (const int frames : {1, 2, 7, 48}) {
        CHECK(loop_alpha(0, frames) == 0.0);
        for (int i = 1; i < frames; ++i) CHECK(loop_alpha(i, frames) == loop_alpha(frames - i, frames));
    }
    CHECK(loop_alpha(24, 48) == Approx(1.0));
    CHECK(loop_alpha(12, 48) == Approx(0.5));
    CHECK(loop_alpha(1, 48) < 0.2 / 24);
    for (int i = 1; i <= 24; ++i) CHECK(loop_alpha(i, 48) > loop_alpha(i - 1, 48));
}

TEST_CASE("a film's frame shows the mean of what the shutter sees") {
    const FigureConfig config = parse_config(kBlurred, "blurred.yaml");
    const Figure figure = render_figure(config);
    const FigureRow& row = figure.rows[0];

    const FilmLoop there = FilmLoop::of_row(config.video, row.motion);
    const Blur morph = blur_of(
        config, row, there, 1, [&](double frame) { return row.motion.at(loop_alpha(frame, 6)); },
        [&](double frame) { return row.motion.shading(loop_alpha(frame, 6)); });
    CHECK(render::largest_t(morph.blurred, morph.sharp) < render::kBlurLimit);
    CHECK(render::largest_t(morph.blurred, morph.middle) > render::kBlurLimit);

    // The axis goes through the middle of the box around the whole motion.
    const FilmLoop table = FilmLoop::on_turntable(config, row.motion);
    render::Bounds bounds;
    for (int i = 0; i <= 6; ++i) bounds.add(row.motion.at(loop_alpha(i, 12)));
    const Eigen::Vector3d& up = config.picture.up;
    const Blur turning = blur_of(
        config, row, table, 2,
        [&](double frame) {
            return turned(row.motion.at(loop_alpha(frame, 12)), bounds.center(), up, 30 * frame);
        },
        [&](double frame) {
            return turned(row.motion.shading(loop_alpha(frame, 12)), {0, 0, 0}, up, 30 * frame);
        });
    CHECK(render::largest_t(turning.blurred, turning.sharp) < render::kBlurLimit);
    CHECK(render::largest_t(turning.blurred, turning.middle) > render::kBlurLimit);
}

TEST_CASE("what is at rest looks the same with the shutter open") {
    const FigureConfig config = parse_config(kBlurred, "blurred.yaml");
    const Figure figure = render_figure(config);
    const FigureRow& row = figure.rows[0];
    const Points V = row.motion.at(0.5);
    const FigureOptions options;
    const Shooting closed = shooting_of(config.picture, options, {48, 36, 8}, {&V});
    Shooting open = closed;
    open.time_steps = 5;
    RowSubject blurred(open, row, {}), sharp(closed, row, {});
    blurred.correct_normals(std::vector<Points>(5, row.motion.shading(0.5)));
    sharp.correct_normals({row.motion.shading(0.5)});
    Blocks a, b;
    for (std::uint32_t pair = 0; pair < render::kBlurPairs; ++pair) {
        a.push_back(render::block_means(blurred.shoot(std::vector<Points>(5, V), {}, {}, 2 * pair).image));
        b.push_back(render::block_means(sharp.shoot({V}, {}, {}, 2 * pair + 1).image));
    }
    CHECK(render::largest_t(a, b) < render::kBlurLimit);
}

TEST_CASE("a film's frame has one moment with the shutter closed, and its own in the middle with it open") {
    for (const double shutter : {0.0, 0.25, 1.0}) {
        const FigureConfig config =
            parse_config(kBlurred, "blurred.yaml", {"video.shutter=" + std::to_string(shutter)});
        const Figure figure = render_figure(config);
        const Motion& motion = figure.rows[0].motion;
        const FilmLoop loop = FilmLoop::of_row(config.video, motion);
        CHECK(loop.time_steps() % 2 == 1);
        CHECK((loop.time_steps() == 1) == (shutter == 0));
        for (const int i : {0, 1, 3}) {
            const std::vector<Points> steps = loop.exposure(i);
            REQUIRE(static_cast<int>(steps.size()) == loop.time_steps());
            CHECK(steps[steps.size() / 2] == motion.at(loop_alpha(i, 6)));
            CHECK(loop.shading(i).size() == steps.size());
        }
        // The way back is the way there, backwards.
        const std::vector<Points> there = loop.exposure(1), back = loop.exposure(5);
        for (std::size_t k = 0; k < there.size(); ++k)
            CHECK((there[k] - back[back.size() - 1 - k]).cwiseAbs().maxCoeff() < 1e-9);
    }
}
