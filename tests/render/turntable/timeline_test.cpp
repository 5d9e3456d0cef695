#include "render/turntable/timeline.h"

#include <cmath>

#include "morph/mesh/errors.h"
#include "tests/catch.h"

using namespace automorph;
using namespace automorph::turntable;

TEST_CASE("easings go from 0 to 1, rise, are symmetrical, and the smooth one rests at its ends") {
    for (const Easing easing : {Easing::Linear, Easing::Smooth}) {
        CHECK(ease(easing, 0) == 0);
        CHECK(ease(easing, 1) == 1);
        for (int i = 0; i < 100; ++i) {
            CHECK(ease(easing, 0.01 * i) < ease(easing, 0.01 * (i + 1)));
            CHECK(ease(easing, 0.01 * i) + ease(easing, 1 - 0.01 * i) == Approx(1));
        }
    }
    constexpr double kStep = 1e-4;
    CHECK(ease(Easing::Linear, kStep) == kStep);
    CHECK(ease(Easing::Smooth, kStep) < 4 * kStep * kStep);
    CHECK(1 - ease(Easing::Smooth, 1 - kStep) < 4 * kStep * kStep);
}

TEST_CASE("a whole turn has no frame twice and closes evenly") {
    for (const double revolutions : {1.0, 2.0, -3.0}) {
        TimelineOptions options;
        options.frames = 24;
        options.start = 30;
        options.revolutions = revolutions;
        options.alpha = 0.0;
        REQUIRE(repeats(options));
        const std::vector<Moment> moments = timeline(options);
        REQUIRE(moments.size() == 24);
        CHECK(moments.front().degrees == 30);
        for (std::size_t i = 0; i < moments.size(); ++i) {
            CHECK(moments[i].alpha == 0);
            CHECK(moments[i].degrees == Approx(30 + 15.0 * revolutions * static_cast<double>(i)));
        }
        // The frame after the last would be the first one again.
        CHECK(moments.back().degrees + 15 * revolutions == Approx(30 + 360 * revolutions));
    }
}

TEST_CASE("what does not repeat ends where it is to end") {
    TimelineOptions options;
    options.frames = 5;
    options.revolutions = 0.25;
    options.alpha = 0.5;
    CHECK_FALSE(repeats(options));
    CHECK(timeline(options).back().degrees == 90);
    options.revolutions = 1;
    options.alpha.reset();
    options.loop = Loop::Once;
    CHECK_FALSE(repeats(options));
    const std::vector<Moment> once = timeline(options);
    CHECK(once.front().alpha == 0);
    CHECK(once.back().alpha == 1);
    CHECK(once.back().degrees == 360);
    options.frames = 1;
    CHECK(timeline(options).size() == 1);
    CHECK(timeline(options).front().alpha == 0);
}

TEST_CASE("ping-pong goes there and back by the same shapes, with both ends once") {
    TimelineOptions options;
    options.frames = 40;
    for (const Easing easing : {Easing::Linear, Easing::Smooth}) {
        options.morph_easing = easing;
        REQUIRE(repeats(options));
        const std::vector<Moment> moments = timeline(options);
        CHECK(moments[0].alpha == 0);
        CHECK(moments[20].alpha == 1);
        int sources = 0, targets = 0;
        for (std::size_t i = 0; i < 40; ++i) {
            sources += moments[i].alpha == 0 ? 1 : 0;
            targets += moments[i].alpha == 1 ? 1 : 0;
            if (i > 0) CHECK(moments[i].alpha == Approx(moments[40 - i].alpha).margin(1e-12));
            if (i < 20) CHECK(moments[i].alpha < moments[i + 1].alpha);
        }
        CHECK(sources == 1);
        CHECK(targets == 1);
    }
    options.morph_easing = Easing::Linear;
    CHECK(timeline(options)[5].alpha == Approx(0.25));
}

TEST_CASE("hold is the share of the sequence at rest at each end") {
    TimelineOptions options;
    options.frames = 1000;
    options.hold = 0.2;
    options.morph_easing = Easing::Linear;
    for (const Loop loop : {Loop::Once, Loop::PingPong}) {
        options.loop = loop;
        double sources = 0, targets = 0;
        for (const Moment& moment : timeline(options)) {
            sources += moment.alpha < 1e-9 ? 1 : 0;
            targets += moment.alpha > 1 - 1e-9 ? 1 : 0;
        }
        CHECK(std::abs(sources - 200) <= 2);
        CHECK(std::abs(targets - 200) <= 2);
    }
}

TEST_CASE("timelines out of range are refused") {
    const auto refused = [](auto change) {
        TimelineOptions options;
        change(options);
        CHECK_THROWS_AS(timeline(options), ConfigError);
    };
    refused([](TimelineOptions& options) { options.frames = 0; });
    refused([](TimelineOptions& options) { options.hold = 0.5; });
    refused([](TimelineOptions& options) { options.hold = -0.1; });
    refused([](TimelineOptions& options) { options.alpha = 1.1; });
    refused([](TimelineOptions& options) { options.revolutions = std::nan(""); });
}

TEST_CASE("an exposure is centred on its frame, and a loop's first one begins in the last round") {
    TimelineOptions options;
    options.frames = 24;
    options.shutter = 0.5;
    const std::vector<Moment> moments = timeline(options);
    const std::vector<Exposure> frames = exposures(options);
    REQUIRE(frames.size() == 24);
    for (std::size_t i = 0; i < 24; ++i) {
        CHECK(frames[i].middle() == moments[i]);
        REQUIRE(frames[i].steps.size() == frames[0].steps.size());
        CHECK(frames[i].steps.front().degrees == Approx(moments[i].degrees - 3.75));
        CHECK(frames[i].steps.back().degrees == Approx(moments[i].degrees + 3.75));
    }
    // Ping-pong: what the shutter sees before the source is what it sees after it.
    CHECK(frames[0].steps.front().alpha == Approx(frames[0].steps.back().alpha));
    CHECK(frames[0].steps.front().alpha > 0);

    options.shutter = 0;
    for (const Exposure& frame : exposures(options)) CHECK(frame.steps.size() == 1);
    // At rest before and after.
    options.shutter = 1;
    options.revolutions = 0.25;
    options.loop = Loop::Once;
    const std::vector<Exposure> once = exposures(options);
    CHECK(once.front().steps.front() == once.front().middle());
    CHECK(once.front().steps.back().degrees > 0);
    CHECK(once.back().steps.back() == Moment{1, 90});
    for (const double wrong : {-0.1, 1.1, std::nan("")}) {
        options.shutter = wrong;
        CHECK_THROWS_AS(exposures(options), ConfigError);
    }
}
