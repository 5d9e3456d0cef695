#include <filesystem>
#include <limits>
#include <sstream>

#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "render/program/arguments.h"
#include "render/program/axis.h"
#include "render/program/commands.h"
#include "render/program/frame_files.h"
#include "render/program/summary.h"
#include "render/program/terminal_progress.h"
#include "tests/catch.h"
#include "tests/render/temporary_folder.h"

using namespace automorph;
using namespace automorph::program;
namespace fs = std::filesystem;

namespace {

std::variant<Arguments, int> read(const std::vector<const char*>& words) {
    std::vector<const char*> all{"automorph"};
    all.insert(all.end(), words.begin(), words.end());
    return read_arguments(static_cast<int>(all.size()), all.data());
}

template <class Command>
Command command_of(const std::vector<const char*>& words) {
    const auto result = read(words);
    REQUIRE(std::holds_alternative<Arguments>(result));
    const Command* command = std::get_if<Command>(&std::get<Arguments>(result).command);
    REQUIRE(command);
    return *command;
}

int status_of(const std::vector<const char*>& words) {
    const auto result = read(words);
    return std::holds_alternative<int>(result) ? std::get<int>(result) : -1;
}

}  // namespace

TEST_CASE("frames are numbered between stem and extension, with at least three digits") {
    CHECK(numbered("m_.ply", 0, 5) == fs::path("m_000.ply"));
    CHECK(numbered("m_.ply", 4, 5) == fs::path("m_004.ply"));
    CHECK(numbered("a.b/x.y.obj", 12, 1000) == fs::path("a.b/x.y012.obj"));
    CHECK(numbered("m.off", 999, 1001) == fs::path("m0999.off"));
    CHECK(numbered("/t/.off", 1, 2).parent_path() == fs::path("/t"));
}

TEST_CASE("a correspondence file reads back to the same doubles, row by row") {
    Points points(3, 3);
    points << 1.0 / 3, -0.1, 1e-300, 12345678.901234567, 0, -5, 0, 0, 0;
    points.row(2).setConstant(std::numeric_limits<double>::quiet_NaN());
    std::istringstream text(points_csv(points));
    std::string line;
    std::getline(text, line);
    CHECK(line == "x,y,z");
    for (int i = 0; i < 2; ++i) {
        REQUIRE(std::getline(text, line));
        std::istringstream fields(line);
        std::string field;
        for (int j = 0; j < 3; ++j) {
            REQUIRE(std::getline(fields, field, ','));
            CHECK(std::stod(field) == points(i, j));
        }
    }
    REQUIRE(std::getline(text, line));
    CHECK(line == "nan,nan,nan");
    CHECK_FALSE(std::getline(text, line));
}

TEST_CASE("the summary tells what was found, and says so when the registration is unsure") {
    Report report;
    report.source.name = "a.obj";
    report.source.vertices = 120;
    report.source.boundary_loops = 3;
    report.source.mended = {"merged 7 duplicate vertices"};
    report.target.name = "b.obj";
    report.target.vertices = 80;
    report.target.closed = true;
    report.registration.used = true;
    report.registration.converged = true;
    report.registration.rotation = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    report.registration.confident = true;
    report.maps = {{"source", "mean value", "cotangent weights flipped 3 triangles", 0, 0.25, 0.1, 1e-12}};
    report.notes = {"a note"};
    report.stages = {{"registration", 0.5, 10}, {"overlay", 0.25, 30}};
    const std::string sure = meshes_summary(report) + morph_summary(report);
    for (const char* phrase :
         {"a.obj: 120 vertices", "3 boundary loops", "merged 7 duplicate vertices", "closed",
          "turned by 90.0 degrees", "mean value (cotangent weights flipped 3 triangles)", "0 flipped",
          "a note", "0.75 s", "peak memory 30 MB"}) {
        INFO(phrase);
        CHECK(sure.find(phrase) != std::string::npos);
    }
    CHECK(sure.find("UNSURE") == std::string::npos);
    CHECK(sure.find("not converged") == std::string::npos);
    report.registration.confident = false;
    CHECK(morph_summary(report).find("UNSURE") != std::string::npos);
    report.registration.converged = false;
    CHECK(morph_summary(report).find("not converged") != std::string::npos);
    report.registration.used = false;
    report.domain = "disk";
    CHECK(morph_summary(report).find("registration  not used") != std::string::npos);
    CHECK(morph_summary(report).find("UNSURE") == std::string::npos);
}

TEST_CASE("the progress bar grows with the fraction and stays within its brackets") {
    CHECK(progress_bar("x", 0, 0) == "[....................]   0 %  x");
    CHECK(progress_bar("x", 0.5, 10) == "[##########..........]  50 %  x, 10 s left");
    CHECK(progress_bar("x", 1, 10) == "[####################] 100 %  x");
    CHECK(progress_bar("x", 7, 10) == progress_bar("x", 1, 10));
    CHECK(progress_bar("x", -7, 10) == progress_bar("x", 0, 10));
    CHECK(progress_bar("x", 0.5, 10, "frame 3") == "[##########..........]  50 %  x, frame 3, 10 s left");
    CHECK(progress_line("x", 0.5, 10, "frame 3") == "x: 50 %, frame 3, 10 s left");
    CHECK(progress_line("x", 0.01, 10) == "x: 1 %");
    CHECK(duration_text(59.4) == "59 s");
    CHECK(duration_text(60) == "1 min 0 s");
    CHECK(duration_text(3599) == "59 min 59 s");
    CHECK(duration_text(7261) == "2 h 1 min");
}

TEST_CASE("progress is told to listeners with and without a taste for details") {
    std::string told;
    Progress plain = [&](const std::string& task, double fraction) {
        told = task + " " + std::to_string(fraction > 0.4);
    };
    plain("a", 0.5, "unheard");
    CHECK(told == "a 1");
    Progress detailed = [&](const std::string& task, double, const std::string& detail) {
        told = task + " " + detail;
    };
    detailed("b", 0.5, "frame 1");
    CHECK(told == "b frame 1");
    CHECK_FALSE(Progress());
    CHECK(plain);
}

TEST_CASE("axes are letters or numbers") {
    CHECK(parse_axis("x") == Eigen::Vector3d(1, 0, 0));
    CHECK(parse_axis("-z") == Eigen::Vector3d(0, 0, -1));
    CHECK((parse_axis("0,3,4") - Eigen::Vector3d(0, 0.6, 0.8)).norm() < 1e-15);
    CHECK((parse_axis("-1e1, 0 ,0") - Eigen::Vector3d(-1, 0, 0)).norm() < 1e-15);
    for (const char* wrong : {"", "-", "w", "xy", "0,0,0", "1,2", "1,2,3,4", "1;2;3", "nan,0,0", "+x"})
        CHECK_THROWS_AS(parse_axis(wrong), ConfigError);
    // Seen from the front, whichever of both conventions the file follows.
    CHECK(usual_view(parse_axis("z")) == Eigen::Vector3d(0, 1, 0));
    CHECK(usual_view(parse_axis("y")) == Eigen::Vector3d(0, 0, -1));
}

TEST_CASE("the command line arrives in full") {
    const auto morph = command_of<MorphArguments>({"morph",
                                                   "a.obj",
                                                   "b.ply",
                                                   "--frames",
                                                   "9",
                                                   "--out",
                                                   "m_.off",
                                                   "--correspondence",
                                                   "c.csv",
                                                   "--report",
                                                   "r.json",
                                                   "--alignment",
                                                   "none",
                                                   "--interpolation",
                                                   "rigid-linear",
                                                   "--domain",
                                                   "sphere",
                                                   "--no-lift",
                                                   "--openings",
                                                   "fill",
                                                   "--seed",
                                                   "77"});
    CHECK(morph.source == fs::path("a.obj"));
    CHECK(morph.target == fs::path("b.ply"));
    CHECK(morph.frames == 9);
    CHECK(morph.out == fs::path("m_.off"));
    CHECK(morph.correspondence == fs::path("c.csv"));
    CHECK(morph.report == fs::path("r.json"));
    CHECK(morph.options.alignment == Alignment::None);
    CHECK(morph.interpolation == Interpolation::RigidLinear);
    CHECK(morph.options.domain == Domain::Sphere);
    CHECK_FALSE(morph.options.lift);
    CHECK(morph.options.openings == Openings::Fill);
    CHECK(morph.options.seed == 77);

    const auto plain = command_of<MorphArguments>({"morph", "a.obj", "b.ply"});
    CHECK(plain.frames == 5);
    CHECK(plain.options.alignment == Alignment::Dense);
    CHECK(plain.interpolation == Interpolation::Slerp);
    CHECK(plain.options.domain == Domain::Auto);
    CHECK(plain.options.lift);

    const auto features = command_of<MorphArguments>({"morph", "a", "b", "--alignment", "features"});
    CHECK(features.options.alignment == Alignment::Features);

    const auto figure = command_of<FigureArguments>(
        {"figure", "x.yaml", "y.yaml", "--out", "d", "--spp", "3", "--scale", "0.5"});
    CHECK(figure.configs == std::vector<fs::path>{"x.yaml", "y.yaml"});
    CHECK(figure.out == fs::path("d"));
    CHECK(figure.spp == 3);
    CHECK(figure.scale == 0.5);

    const auto turning = command_of<TurntableArguments>(
        {"turntable", "a.off",         "b.off",  "--out",         "t.mp4",      "--frames",
         "12",        "--revolutions", "-1.5",   "--start",       "30",         "--turn-easing",
         "smooth",    "--easing",      "linear", "--loop",        "once",       "--hold",
         "0.2",       "--up",          "z",      "--view",        "-x",         "--elevation",
         "30",        "--width",       "320",    "--height",      "200",        "--spp",
         "7",         "--seed",        "5",      "--frame-range", "2-4",        "--fps",
         "30",        "--redo",        "--flat", "--alignment",   "features",   "--interpolation",
         "linear",    "--domain",      "sphere", "--no-lift",     "--openings", "fill"});
    CHECK(turning.source == fs::path("a.off"));
    CHECK(turning.target == fs::path("b.off"));
    CHECK(turning.out == fs::path("t.mp4"));
    CHECK(turning.timeline.frames == 12);
    CHECK(turning.timeline.revolutions == -1.5);
    CHECK(turning.timeline.start == 30);
    CHECK(turning.timeline.turn_easing == turntable::Easing::Smooth);
    CHECK(turning.timeline.morph_easing == turntable::Easing::Linear);
    CHECK(turning.timeline.loop == turntable::Loop::Once);
    CHECK(turning.timeline.hold == 0.2);
    CHECK_FALSE(turning.timeline.alpha);
    CHECK(turning.up == "z");
    CHECK(turning.view == "-x");
    CHECK(turning.elevation == 30);
    CHECK(turning.width == 320);
    CHECK(turning.height == 200);
    CHECK(turning.spp == 7);
    CHECK(turning.seed == 5);
    CHECK(turning.frame_range == "2-4");
    CHECK(turning.fps == 30);
    CHECK(turning.redo);
    CHECK(turning.flat);
    CHECK(turning.morph.alignment == Alignment::Features);
    CHECK(turning.interpolation == Interpolation::Linear);
    CHECK(turning.morph.domain == Domain::Sphere);
    CHECK_FALSE(turning.morph.lift);
    CHECK(turning.morph.openings == Openings::Fill);
    CHECK(command_of<TurntableArguments>({"turntable", "a", "b", "--alpha", "0.5"}).timeline.alpha == 0.5);

    const auto star =
        command_of<StarArguments>({"shape", "star", "s.ply", "--arms", "7", "--triangles", "100"});
    CHECK(star.parameters.arms == 7);
    CHECK(star.options.triangles == 100);
    const auto round =
        command_of<EllipsoidArguments>({"shape", "ellipsoid", "e.ply", "--semi-axes", "1", "2", "3"});
    CHECK(round.semi_axes == std::vector<double>{1, 2, 3});

    const auto head = command_of<HeadArguments>(
        {"shape", "head", "h.ply", "--preset", "child", "--crop", "face", "--nose-width", "1.2"});
    CHECK(head.preset == HeadPreset::Child);
    CHECK(head.crop == HeadCrop::Face);
    for (std::size_t k = 0; k < kHeadParameters.size(); ++k) {
        const bool is_changed = std::string(kHeadParameters[k].name) == "nose_width";
        CHECK(head.proportions[k] == (is_changed ? std::optional<double>(1.2) : std::nullopt));
    }

    const auto all = std::get<Arguments>(read({"morph", "a", "b", "--threads", "2", "-q"}));
    CHECK(all.threads == 2);
    CHECK(all.quiet);
    CHECK(all.log_level == LogLevel::Error);
    const auto level = [&](const char* name) {
        return std::get<Arguments>(read({"info", "a", "--log-level", name}));
    };
    CHECK(level("warning").quiet);
    CHECK(level("debug").log_level == LogLevel::Debug);
    CHECK_FALSE(level("info").quiet);
}

TEST_CASE("a wrong command line ends with status 1, help and version with 0") {
    CHECK(status_of({}) == 1);
    CHECK(status_of({"nonsense"}) == 1);
    CHECK(status_of({"morph", "a.obj"}) == 1);
    CHECK(status_of({"morph", "a", "b", "--frames", "1"}) == 1);
    CHECK(status_of({"morph", "a", "b", "--alignment", "magic"}) == 1);
    CHECK(status_of({"morph", "a", "b", "--unknown"}) == 1);
    CHECK(status_of({"figure"}) == 1);
    CHECK(status_of({"turntable"}) == 1);
    CHECK(status_of({"turntable", "a", "--loop", "once"}) == 1);
    CHECK(status_of({"turntable", "a", "b", "--alpha", "0.5", "--hold", "0.1"}) == 1);
    CHECK(status_of({"turntable", "a", "--elevation", "90"}) == 1);
    CHECK(status_of({"info", "a", "--log-level", "loud"}) == 1);
    CHECK(status_of({"info", "a", "--log-level", "info", "-q"}) == 1);
    CHECK(status_of({"turntable", "--help"}) == 0);
    CHECK(status_of({"figure", "x.yaml", "--scale", "0"}) == 1);
    CHECK(status_of({"shape", "star"}) == 1);
    CHECK(status_of({"shape", "star", "x.ply", "--arms", "2"}) == 1);
    CHECK(status_of({"shape", "head", "h.ply", "--preset", "martian"}) == 1);
    CHECK(status_of({"shape", "head", "h.ply", "--nose-width", "9"}) == 1);
    CHECK(status_of({"--help"}) == 0);
    CHECK(status_of({"morph", "--help"}) == 0);
    CHECK(status_of({"--version"}) == 0);
}

TEST_CASE("what cannot be written is refused before the work, and nothing is left") {
    const TemporaryFolder folder;
    const Surroundings quiet{true, 0, {}};
    write_mesh(folder / "a.off", ellipsoid({1, 1, 1}, {.triangles = 100}));
    MorphArguments arguments;
    arguments.source = arguments.target = folder / "a.off";
    arguments.out = folder / "m_.png";
    CHECK_THROWS_AS(run(arguments, quiet), IoError);
    arguments.out = folder / "a.off/below/m_.ply";
    CHECK_THROWS_AS(run(arguments, quiet), IoError);
    StarArguments star{folder / "s.ply", {5, 1.0, 2.0, 0.3}, {}};
    CHECK_THROWS_AS(run(star, quiet), ConfigError);
    CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("two configs that would write to one folder are refused") {
    FigureArguments arguments;
    arguments.configs = {fs::path(AUTOMORPH_CONFIGS) / "fig7.yaml",
                         fs::path(AUTOMORPH_CONFIGS) / "fig7.yaml"};
    CHECK_THROWS_AS(run(arguments, {true, 0, {}}), ConfigError);
}
