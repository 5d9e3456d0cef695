#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/mesh/write_gate.h"
#include "render/program/arguments.h"
#include "render/program/axis.h"
#include "render/program/commands.h"
#include "render/program/frame_files.h"
#include "render/program/help_topics.h"
#include "render/program/interrupt.h"
#include "render/program/man_page.h"
#include "render/program/mesh_info.h"
#include "render/program/summary.h"
#include "render/program/terminal_progress.h"
#include "tests/catch.h"
#include "tests/files.h"

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

TEST_CASE("what a figure makes and how well is told on the command line") {
    const auto figure = command_of<FigureArguments>(
        {"figure", "a.yaml", "--quality", "draft", "--rows", "1,3-4", "--cells", "2", "--frames", "1-8",
         "--set", "picture.spp=4", "--set", "alphas=[0, 1]", "--dry-run", "b.yaml"});
    CHECK(figure.quality == Quality::Draft);
    CHECK(figure.rows == "1,3-4");
    CHECK(figure.cells == "2");
    CHECK(figure.frames == "1-8");
    CHECK(figure.overrides == std::vector<std::string>{"picture.spp=4", "alphas=[0, 1]"});
    CHECK(figure.dry_run);
    CHECK(figure.configs.size() == 2);
    CHECK(command_of<FigureArguments>({"figure", "a.yaml"}).quality == Quality::Normal);
    CHECK(status_of({"figure", "a.yaml", "--quality", "best"}) == 1);
    CHECK(command_of<ConfigArguments>({"config", "--schema"}).schema);
}

TEST_CASE("frames are numbered between stem and extension, with at least three digits") {
    CHECK(numbered("m_.ply", 0, 5) == fs::path("m_000.ply"));
    CHECK(numbered("m_.ply", 4, 5) == fs::path("m_004.ply"));
    CHECK(numbered("a.b/x.y.obj", 12, 1000) == fs::path("a.b/x.y012.obj"));
    CHECK(numbered("m.off", 999, 1001) == fs::path("m0999.off"));
    CHECK(numbered("/t/.off", 1, 2).parent_path() == fs::path("/t"));
}

TEST_CASE("frames that a longer sequence left are told of") {
    const TemporaryFolder folder;
    const fs::path pattern = folder / "m_.ply";
    CHECK(told_of_further_frames(pattern, 2).empty());
    for (int i : {0, 1, 2, 4}) std::ofstream(numbered(pattern, i, 5)) << "x";
    CHECK(told_of_further_frames(pattern, 3).empty());
    CHECK(told_of_further_frames(pattern, 2) ==
          (folder / "m_002.ply").string() +
              " lies there, too, of an earlier sequence: not among these 2 frames");
    CHECK(told_of_further_frames(pattern, 1) ==
          (folder / "m_001.ply").string() +
              " and 1 more lie there, too, of an earlier sequence: not among these 1 frames");
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
    MapReport& map = report.maps.emplace_back();
    map.of = "source";
    map.weights = "mean value";
    map.reason = "cotangent weights flipped 3 triangles";
    map.p01 = 0.25;
    map.smallest_ratio = 0.1;
    map.residual = 1e-12;
    report.notes = {"a note"};
    report.stages = {{"registration", 0.5, 10}, {"overlay", 0.25, 30}};
    const std::string sure = meshes_summary(report) + morph_summary(report);
    for (const char* phrase :
         {"a.obj: 120 vertices", "3 boundary loops", "merged 7 duplicate vertices", "closed",
          "turned by 90.0 degrees", "mean value (cotangent weights flipped 3 triangles)", "0 flipped",
          "99 % of the surface shrunk less than 4 times", "a note", "0.75 s", "peak memory 30 MB"}) {
        INFO(phrase);
        CHECK(sure.find(phrase) != std::string::npos);
    }
    CHECK(sure.find("UNSURE") == std::string::npos);
    CHECK(sure.find("not converged") == std::string::npos);
    CHECK(doubts(report).empty());
    report.registration.confident = false;
    report.registration.residual = 0.25;
    report.registration.runner_up = 0.2625;
    CHECK(morph_summary(report).find("UNSURE") != std::string::npos);
    REQUIRE(doubts(report).size() == 1);
    CHECK(doubts(report)[0].find("nearly as well (residual 0.2625 against 0.2500") != std::string::npos);
    report.registration.runner_up = 0.2375;
    REQUIRE(doubts(report).size() == 1);
    CHECK(doubts(report)[0].find("a little better (residual 0.2375 against 0.2500)") != std::string::npos);
    CHECK(doubts(report)[0].find("turns the source least is taken") != std::string::npos);
    CHECK(doubts(report)[0].find("nearly as well") == std::string::npos);
    report.registration.converged = false;
    CHECK(morph_summary(report).find("not converged") != std::string::npos);
    report.registration.used = false;
    report.domain = "disk";
    CHECK(morph_summary(report).find("registration  not used") != std::string::npos);
    CHECK(morph_summary(report).find("UNSURE") == std::string::npos);
}

TEST_CASE("help topics fit a terminal and have names of their own") {
    std::set<std::string> names;
    for (const HelpTopic& topic : help_topics()) {
        CHECK(names.insert(topic.name).second);
        CHECK(list_of_topics().find(topic.name) != std::string::npos);
        std::istringstream text(topic.text);
        for (std::string line; std::getline(text, line);) {
            INFO(topic.name << ": " << line);
            CHECK(line.size() <= 80);
        }
    }
}

TEST_CASE("the manual page has every command and option, and no line that troff would take for its own") {
    CommandEntry program;
    program.about = ".about\n'quoted' \\ text";
    program.options = {{{"--quiet", "-q"}, "", "", "", "", "Says nothing", false}};
    CommandEntry shape{{"shape"}, "Shapes", "", {}, {}};
    shape.commands = {{{"shape", "star"},
                       "A star",
                       "Examples:\n  .hidden file",
                       {{{}, "OUT", "FILE", "", "", "Where to", true},
                        {{"--arms"}, "", "N", "in [3 - 64]", "5", "How many", false},
                        {{"--kind"}, "", "round|sharp", "", "sharp", "Which", false}},
                       {}}};
    program.commands = {shape};
    const std::string page = man_page(program, "1.2.3");
    for (const char* part : {"automorph 1.2.3", "\n\\&.about\n\\&'quoted' \\e text\n", "\n.SS shape star\n",
                             "\\fBautomorph shape star\\fR [\\fIOPTIONS\\fR] \\fIOUT\\fR",
                             "\\fB\\-\\-arms\\fR \\fIN\\fR\n", "How many (in [3 \\- 64], default 5)",
                             "\n.nf\n  .hidden file\n.fi\n", "\\fB\\-\\-quiet\\fR, \\fB\\-q\\fR"}) {
        INFO(part);
        CHECK(page.find(part) != std::string::npos);
    }
    for (const HelpTopic& topic : help_topics()) {
        std::string heading = std::string("\n.SH ") + topic.title + "\n";
        for (char& c : heading) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        CHECK(page.find(heading) != std::string::npos);
    }
    CHECK(program.commands[0].commands[0].options[2].choices() == std::vector<std::string>{"round", "sharp"});
}

TEST_CASE("a mesh file is described by counts, size, borders, and what would be mended") {
    const TemporaryFolder folder;
    // A square of two triangles, one with corners of its own, and a vertex that nothing uses.
    std::ofstream(folder / "square.off")
        << "OFF\n7 2 0\n0 0 0\n3 0 0\n3 4 0\n0 0 0\n3 4 0\n0 4 0\n9 9 9\n3 0 1 2\n3 3 4 5\n";
    const MeshInfo info = examine(folder / "square.off");
    CHECK(info.refusal.empty());
    CHECK(info.found.vertices == 7);
    CHECK(info.found.components == 2);
    CHECK(info.found.duplicate_vertices == 2);
    CHECK(info.found.unused_vertices == 1);
    CHECK(info.admitted.vertices == 4);
    CHECK(info.mended.size() == 2);
    REQUIRE(info.loops.size() == 1);
    CHECK(info.loops[0].vertices == 4);
    CHECK(info.loops[0].length == Approx(14));
    CHECK(info.area == Approx(12));
    CHECK(info.high == Eigen::Vector3d(9, 9, 9));
    const std::string text = info_text(info);
    for (const char* part :
         {"7 vertices, 2 polygons", "9 x 9 x 9", "2 duplicate vertices, 1 unused vertex",
          "the border of 4 vertices, 14 long", "can be morphed: 4 vertices, 2 triangles, open"}) {
        INFO(part);
        CHECK(text.find(part) != std::string::npos);
    }
    CHECK(std::count(text.begin(), text.end(), '\n') == 10);
    CHECK(text.find("  mending    ") != std::string::npos);

    write_mesh(folder / "ball.off", ellipsoid({1, 1, 1}, {.triangles = 2000}));
    const MeshInfo ball = examine(folder / "ball.off");
    CHECK(ball.volume == Approx(4.0 / 3.0 * 3.14159265).epsilon(0.01));
    const std::string gone = info_text(examine(folder / "gone.off"));
    CHECK(gone.find("gone.off") == gone.rfind("gone.off"));
    CHECK(gone.find("cannot be read: ") != std::string::npos);
    const auto json = nlohmann::json::parse(info_json({info, ball, examine(folder / "gone.off")}));
    REQUIRE(json.size() == 3);
    CHECK(json[0]["admissible"] == true);
    CHECK(json[0]["found"]["duplicate_vertices"] == 2);
    CHECK(json[0]["loops"][0]["length"] == Approx(14));
    CHECK_FALSE(json[0].contains("volume"));
    CHECK(json[1]["volume"] == Approx(ball.volume));
    CHECK(json[1]["admitted"]["genus"] == 0);
    CHECK(json[2]["admissible"] == false);
    CHECK(json[2]["refusal"].get<std::string>().find("gone.off") != std::string::npos);
    CHECK_FALSE(json[2].contains("found"));
}

TEST_CASE("a row of a correspondence is a vertex of the file, whatever was mended") {
    const TemporaryFolder folder;
    // The shape as an .stl would have it, every triangle with corners of its own, a vertex that nothing uses
    // in front, and a stray triangle at the end.
    const Mesh shape = ellipsoid({1, 0.7, 0.5}, {.triangles = 200});
    Mesh torn;
    torn.V.resize(3 * shape.F.rows() + 4, 3);
    torn.F.resize(shape.F.rows() + 1, 3);
    torn.V.row(0).setConstant(0.25);
    for (int f = 0; f < shape.F.rows(); ++f) {
        for (int k = 0; k < 3; ++k) {
            torn.F(f, k) = 1 + 3 * f + k;
            torn.V.row(1 + 3 * f + k) = shape.V.row(shape.F(f, k));
        }
    }
    const int last = static_cast<int>(torn.V.rows()) - 3;
    torn.F.row(shape.F.rows()) << last, last + 1, last + 2;
    torn.V.bottomRows(3) << 0, 0, 0, 0.01, 0, 0, 0, 0.01, 0;
    write_mesh(folder / "torn.ply", torn);
    write_mesh(folder / "whole.ply", shape);

    MorphArguments arguments;
    arguments.source = folder / "torn.ply";
    arguments.target = folder / "whole.ply";
    arguments.correspondence = folder / "c.csv";
    run(arguments, {true, 0, {}});
    std::ifstream csv(folder / "c.csv");
    std::string line;
    std::getline(csv, line);
    CHECK(line == "x,y,z");
    for (int v = 0; v < torn.V.rows(); ++v) {
        INFO("vertex " << v);
        REQUIRE(std::getline(csv, line));
        if (v == 0 || v >= last) {
            CHECK(line == "nan,nan,nan");
            continue;
        }
        Eigen::RowVector3d to;
        REQUIRE(std::sscanf(line.c_str(), "%lf,%lf,%lf", &to[0], &to[1], &to[2]) == 3);
        CHECK((to - torn.V.row(v)).norm() < 0.02);  // the target is the same shape
    }
    CHECK_FALSE(std::getline(csv, line));
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
    CHECK(progress_bar("x", Progress::kUnknown, 10, "third stage") == "x: third stage");
    CHECK(progress_line("x", Progress::kUnknown, 10) == "x");
    CHECK(duration_text(59.4) == "59 s");
    CHECK(duration_text(60) == "1 min 0 s");
    CHECK(duration_text(3599) == "59 min 59 s");
    CHECK(duration_text(7261) == "2 h 1 min");
}

TEST_CASE("a bar is cut to the columns of a terminal, and no character with it") {
    CHECK(cut_to_columns("abc", 3) == "abc");
    CHECK(cut_to_columns("abc", 2) == "ab");
    CHECK(cut_to_columns("abc", 0).empty());
    CHECK(cut_to_columns("\u00e4\u03b1b", 2) == "\u00e4\u03b1");
    CHECK(cut_to_columns("a\u9762\u9762", 4) == "a\u9762");  // two columns each
    CHECK(cut_to_columns("\xff\x80\x80", 9) == "\xff\x80\x80");
}

TEST_CASE("a second signal does not wait for the file that is being written") {
    constexpr const char* kSignalled = "AUTOMORPH_TEST_SIGNALLED";
    if (std::getenv(kSignalled) != nullptr) {  // the process that this test starts
        ::signal(SIGINT, SIG_DFL);
        end_on_signals();
        const UnbrokenWrite whole;
        ::raise(SIGINT);
        [[maybe_unused]] const auto told = ::write(STDOUT_FILENO, "\1", 1);
        ::raise(SIGINT);
        return;
    }
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(ends[1], STDOUT_FILENO);
        ::setenv(kSignalled, "1", 1);
        ::execl("/proc/self/exe", "program_test", "a second signal does not wait*", nullptr);
        ::_exit(97);
    }
    ::close(ends[1]);
    std::string told;
    for (char c = 0; ::read(ends[0], &c, 1) == 1;) told += c;
    ::close(ends[0]);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
    CHECK(told.find('\1') != std::string::npos);  // the first did wait
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

    const auto animated = command_of<MorphArguments>(
        {"morph", "a", "b", "--out", "m.glb", "--seconds", "0.5", "--ping-pong", "--up", "z"});
    CHECK(animated.out == fs::path("m.glb"));
    CHECK(animated.seconds == 0.5);
    CHECK(animated.ping_pong);
    CHECK(animated.up == UpAxis::Z);

    const auto plain = command_of<MorphArguments>({"morph", "a.obj", "b.ply"});
    CHECK(plain.frames == 5);
    CHECK(plain.options.alignment == Alignment::Dense);
    CHECK(plain.interpolation == Interpolation::Slerp);
    CHECK(plain.options.domain == Domain::Auto);
    CHECK(plain.options.lift);
    CHECK(plain.seconds == 2);
    CHECK_FALSE(plain.ping_pong);
    CHECK(plain.up == UpAxis::Y);

    const auto features = command_of<MorphArguments>({"morph", "a", "b", "--alignment", "features"});
    CHECK(features.options.alignment == Alignment::Features);

    const auto figure = command_of<FigureArguments>(
        {"figure", "x.yaml", "y.yaml", "--out", "d", "--spp", "3", "--scale", "0.5", "--denoise"});
    CHECK(figure.configs == std::vector<fs::path>{"x.yaml", "y.yaml"});
    CHECK(figure.out == fs::path("d"));
    CHECK(figure.spp == 3);
    CHECK(figure.denoise);
    CHECK_FALSE(FigureArguments{}.denoise);
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
    CHECK(status_of({"morph", "a", "b", "--out", "m.glb", "--frames", "3"}) == 1);
    CHECK(status_of({"morph", "a", "b", "--out", "m_.ply", "--seconds", "3"}) == 1);
    CHECK(status_of({"morph", "a", "b", "--ping-pong"}) == 1);
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
    CHECK(status_of({"help"}) == 0);
    CHECK(status_of({"help", "--man"}) == 0);
    CHECK(status_of({"help", "knitting"}) == 1);
    CHECK(status_of({"completion", "tcsh"}) == 1);
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
