#include "render/turntable/stage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "morph/mesh/errors.h"
#include "morph/shapes/shapes.h"
#include "tests/catch.h"
#include "tests/render/blur.h"

using namespace automorph;
using namespace automorph::turntable;

namespace {

/// A slab far off the origin that grows with alpha.
Shape growing_slab() {
    const Mesh mesh = ellipsoid({1.0, 0.3, 0.5}, {.triangles = 300});
    return {mesh.F, [V = mesh.V](double alpha) {
                Points moved = V * (1 + alpha);
                moved.rowwise() += Eigen::RowVector3d(100 + 3 * alpha, -20, 7);
                return moved;
            }};
}

StageOptions small() {
    StageOptions options;
    options.width = 48;
    options.height = 36;
    options.spp = 4;
    return options;
}

std::vector<Exposure> frames_of(int frames, double revolutions = 1) {
    TimelineOptions options;
    options.frames = frames;
    options.revolutions = revolutions;
    return exposures(options);
}

/// A picture that is not blurred.
Exposure at(double alpha, double degrees, int steps = 1) {
    return {std::vector<Moment>(static_cast<std::size_t>(steps), Moment{alpha, degrees})};
}

double mean(const render::Image& image) {
    double sum = 0;
    for (const float value : image.pixels) sum += value;
    return sum / static_cast<double>(image.pixels.size());
}

}  // namespace

TEST_CASE(
    "in no frame a vertex is outside of the picture less its margin, and the camera keeps its distance") {
    for (const double revolutions : {1.0, 0.3, -2.0, 0.0}) {
        for (const double elevation : {0.0, 14.0, 60.0}) {
            StageOptions options = small();
            options.elevation = elevation;
            const std::vector<Exposure> frames = frames_of(17, revolutions);
            const Stage stage(growing_slab(), frames, options);
            double least = 1e9, distance = 0;
            for (const Exposure& frame : frames) {
                const Moment& moment = frame.middle();
                const render::Camera camera = stage.camera(moment.degrees);
                const render::PictureCamera view(camera, options.width, options.height);
                const double away = (camera.position - camera.target).norm();
                if (distance > 0) CHECK(away == Approx(distance));
                distance = away;
                const Points V = stage.standing(moment.alpha);
                for (Eigen::Index i = 0; i < V.rows(); ++i) {
                    const Eigen::Vector2d p = view.project(V.row(i).transpose()).value();
                    const double x = 2 * p.x() / options.width, y = 2 * p.y() / options.height;
                    least = std::min({least, x, 2 - x, y, 2 - y});
                }
            }
            INFO(revolutions << " " << elevation);
            CHECK(least > options.margin - 1e-9);
            // No more is left free than all alphas at all angles need.
            CHECK(least < 0.5);
        }
    }
}

TEST_CASE("every in-between stands on the floor, upright") {
    StageOptions options = small();
    options.up = {0, 1, 0};
    options.view = {0, 0, -1};
    const Stage stage(growing_slab(), frames_of(8), options);
    for (const double alpha : {0.0, 0.4, 1.0}) {
        const Points V = stage.standing(alpha);
        CHECK(V.col(2).minCoeff() == Approx(0).margin(1e-9));
        // The half extents 1, 0.3, 0.5 of x, y, z; y is up and x to the right.
        CHECK(V.col(2).maxCoeff() == Approx(0.6 * (1 + alpha)).epsilon(0.05));
        CHECK(V.col(0).maxCoeff() - V.col(0).minCoeff() == Approx(2 * (1 + alpha)).epsilon(0.05));
    }
    // What lies nearer to the viewer has the smaller y: z of the file, turned round.
    const Points file = growing_slab().vertices(0), world = stage.standing(0);
    CHECK(world(1, 1) - world(0, 1) == Approx(-(file(1, 2) - file(0, 2))));
}

TEST_CASE("the camera goes round as if the shape turned counter-clockwise seen from above") {
    const Stage stage(growing_slab(), frames_of(8), small());
    const render::Camera front = stage.camera(0), quarter = stage.camera(90);
    CHECK(front.position.x() == Approx(0).margin(1e-9));
    CHECK(front.position.y() < 0);
    // What the camera saw from the front has turned to its right, so it stands where the left side was.
    CHECK(quarter.position.x() == Approx(front.position.y()));
    CHECK(quarter.position.z() == Approx(front.position.z()));
    const render::PictureCamera view(stage.camera(40), 100, 100);
    const render::PictureCamera before(stage.camera(30), 100, 100);
    const Eigen::Vector3d near = Eigen::Vector3d(0, -1, 0);  // of the axis, in front of it
    CHECK(view.project(near).value().x() > before.project(near).value().x());
}

TEST_CASE("light and floor are the same from all sides: a turned round shape gives the same picture") {
    const Mesh mesh = ellipsoid({0.5, 0.5, 1.0}, {.triangles = 20000});
    StageOptions options = small();
    options.spp = 256;
    Stage stage({mesh.F, [V = mesh.V](double) { return V; }}, frames_of(8), options);
    const render::Image front = stage.picture(at(0, 0), 0).image;
    for (const double degrees : {73.0, 180.0, -45.0}) {
        const render::Image turned = stage.picture(at(0, degrees), 0).image;
        double sum = 0;
        for (std::size_t i = 0; i < front.pixels.size(); ++i)
            sum += std::abs(front.pixels[i] - turned.pixels[i]);
        CHECK(sum / static_cast<double>(front.pixels.size()) < 0.01);
        CHECK(mean(turned) == Approx(mean(front)).epsilon(0.002));
    }
}

TEST_CASE("with an open shutter a frame is the mean of what turns and morphs before it, under fixed light") {
    constexpr int kFrame = 2, kSharp = 8, kFine = 640;  // moments between two frames
    TimelineOptions options;
    options.frames = 8;
    options.shutter = 0.8;
    const std::vector<Exposure> frames = exposures(options);
    const Exposure& exposure = frames[kFrame];
    const auto steps = static_cast<int>(exposure.steps.size());
    Shape slab = growing_slab();
    slab.vertices = [at = slab.vertices](double alpha) { return at(0.3 * alpha); };
    StageOptions picture = small();
    picture.spp = 8;
    Stage stage(slab, frames, picture);
    TimelineOptions fine = options;
    fine.frames = kFine * options.frames;
    const std::vector<Moment> moments = timeline(fine);
    std::vector<std::vector<double>> blurred, middle, sharp;
    int noise = 0;
    for (int pair = 0; pair < render::kBlurPairs; ++pair) {
        blurred.push_back(render::block_means(stage.picture(exposure, noise++).image));
        const Moment own = exposure.middle();
        middle.push_back(
            render::block_means(stage.picture(at(own.alpha, own.degrees, steps), noise++).image));
        std::vector<double>& mean_of = sharp.emplace_back(middle.back().size(), 0.0);
        for (int k = 0; k < kSharp; ++k) {
            const double frame = kFrame + options.shutter * render::sharp_moment(pair, k, kSharp);
            const Moment& moment = moments[static_cast<std::size_t>(std::lround(kFine * frame))];
            const std::vector<double> one =
                render::block_means(stage.picture(at(moment.alpha, moment.degrees, steps), noise++).image);
            for (std::size_t i = 0; i < one.size(); ++i) mean_of[i] += one[i] / kSharp;
        }
    }
    CHECK(render::largest_t(blurred, sharp) < render::kBlurLimit);
    CHECK(render::largest_t(blurred, middle) > render::kBlurLimit);
    // A shutter of another length is seen.
    TimelineOptions shorter = options;
    shorter.shutter = 0.6;
    Exposure other = exposures(shorter)[kFrame];
    while (other.steps.size() < exposure.steps.size()) other.steps.push_back(other.steps.back());
    other.steps.resize(exposure.steps.size());
    std::vector<std::vector<double>> wrong;
    for (int pair = 0; pair < render::kBlurPairs; ++pair)
        wrong.push_back(render::block_means(stage.picture(other, noise++).image));
    CHECK(render::largest_t(wrong, sharp) > render::kBlurLimit);
}

TEST_CASE("what does not move has the same bits with the shutter open, and the same look at more moments") {
    TimelineOptions options;
    options.frames = 3;
    options.revolutions = 0;
    options.alpha = 0.5;
    StageOptions picture = small();
    picture.spp = 8;
    Stage closed(growing_slab(), exposures(options), picture);
    options.shutter = 1;
    const std::vector<Exposure> frames = exposures(options);
    CHECK(frames[1].steps.size() == 1);
    Stage open(growing_slab(), frames, picture);
    CHECK(open.picture(frames[1], 1).image.pixels == closed.picture(at(0.5, 0), 1).image.pixels);

    Stage more(growing_slab(), {at(0.5, 0, 5)}, picture);
    Stage one(growing_slab(), {at(0.5, 0)}, picture);
    std::vector<std::vector<double>> a, b;
    for (int pair = 0; pair < render::kBlurPairs; ++pair) {
        a.push_back(render::block_means(more.picture(at(0.5, 0, 5), 2 * pair).image));
        b.push_back(render::block_means(one.picture(at(0.5, 0), 2 * pair + 1).image));
    }
    CHECK(render::largest_t(a, b) < render::kBlurLimit);
}

TEST_CASE("a blurred frame has the same bits whatever frame came before, and nothing of it is cut off") {
    TimelineOptions timing;
    timing.frames = 6;
    timing.revolutions = 0.5;
    timing.shutter = 1;
    const std::vector<Exposure> frames = exposures(timing);
    const StageOptions options = small();
    Stage a(growing_slab(), frames, options), b(growing_slab(), frames, options);
    std::vector<render::Image> forwards;
    for (int i = 0; i < 6; ++i) forwards.push_back(a.picture(frames[static_cast<std::size_t>(i)], i).image);
    for (int i = 5; i >= 0; --i) {
        const auto index = static_cast<std::size_t>(i);
        CHECK(b.picture(frames[index], i).image.pixels == forwards[index].pixels);
    }
    double least = 1e9;
    for (const Exposure& frame : frames) {
        for (const Moment& moment : frame.steps) {
            const render::PictureCamera view(a.camera(moment.degrees), options.width, options.height);
            const Points V = a.standing(moment.alpha);
            for (Eigen::Index i = 0; i < V.rows(); ++i) {
                const Eigen::Vector2d p = view.project(V.row(i).transpose()).value();
                const double x = 2 * p.x() / options.width, y = 2 * p.y() / options.height;
                least = std::min({least, x, 2 - x, y, 2 - y});
            }
        }
    }
    CHECK(least > options.margin - 1e-9);
}

TEST_CASE("a frame has the same bits for any number of threads and whatever frame came before") {
    StageOptions one = small(), three = small();
    one.threads = 1;
    three.threads = 3;
    const std::vector<Exposure> frames = frames_of(6);
    Stage a(growing_slab(), frames, one), b(growing_slab(), frames, three);
    std::vector<render::Image> forwards;
    for (int i = 0; i < 6; ++i) forwards.push_back(a.picture(frames[static_cast<std::size_t>(i)], i).image);
    for (int i = 5; i >= 0; --i) {
        const auto index = static_cast<std::size_t>(i);
        CHECK(b.picture(frames[index], i).image.pixels == forwards[index].pixels);
    }
}

TEST_CASE("the noise differs from frame to frame and from seed to seed") {
    StageOptions options = small(), other = small();
    other.seed = 2;
    const std::vector<Exposure> frames = frames_of(4);
    Stage stage(growing_slab(), frames, options), reseeded(growing_slab(), frames, other);
    const render::Image first = stage.picture(frames[0], 0).image;
    CHECK(first.pixels != stage.picture(frames[0], 1).image.pixels);
    CHECK(first.pixels != reseeded.picture(frames[0], 0).image.pixels);
    CHECK(first.pixels == stage.picture(frames[0], 0).image.pixels);
}

TEST_CASE("a stage that cannot be set is refused") {
    const std::vector<Exposure> frames = frames_of(4);
    StageOptions along = small(), below = small(), flat = small();
    along.view = along.up;
    CHECK_THROWS_AS(Stage(growing_slab(), frames, along), ConfigError);
    below.elevation = -1;
    CHECK_THROWS_AS(Stage(growing_slab(), frames, below), ConfigError);
    flat.up.setZero();
    CHECK_THROWS_AS(Stage(growing_slab(), frames, flat), ConfigError);
    CHECK_THROWS_AS(Stage(growing_slab(), {}, small()), ConfigError);
    Shape nothing = growing_slab();
    nothing.vertices = [](double) { return Points::Constant(200, 3, std::nan("")).eval(); };
    CHECK_THROWS_AS(Stage(nothing, frames, small()), Error);
}
