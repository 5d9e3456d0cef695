// Runs the built program as a user does.

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "morph/mesh/io.h"
#include "tests/catch.h"
#include "tests/render/program/run_program.h"

namespace fs = std::filesystem;

namespace {

void make_shapes(const TemporaryFolder& folder) {
    REQUIRE(
        run_program(folder, "shape ellipsoid a.off --semi-axes 1 0.8 0.5 --triangles 300 --seed 2").status ==
        0);
    REQUIRE(run_program(folder, "shape star b.ply --triangles 400").status == 0);
}

}  // namespace

TEST_CASE("help teaches by examples and the version is told") {
    const TemporaryFolder folder;
    const Run help = run_program(folder, "--help");
    CHECK(help.status == 0);
    for (const char* phrase :
         {"figure", "morph", "shape", "info", "--version", "automorph figure configs/fig7.yaml"}) {
        INFO(phrase);
        CHECK(help.out.find(phrase) != std::string::npos);
    }
    CHECK(run_program(folder, "morph --help").out.find("--correspondence") != std::string::npos);
    const Run version = run_program(folder, "--version");
    CHECK(version.out.rfind("automorph ", 0) == 0);
    for (const char* library : {"Embree ", "OpenImageIO ", "Eigen ", "CGAL ", "OpenMesh ", "yaml-cpp "}) {
        const auto at = version.out.find(library);
        INFO(version.out);
        REQUIRE(at != std::string::npos);
        CHECK(std::isdigit(static_cast<unsigned char>(version.out[at + std::strlen(library)])));
    }
    CHECK(run_program(folder, "config --explain").out.find("picture.spp\n") != std::string::npos);
    const std::string shapes = run_program(folder, "shape star --help").out;
    CHECK(shapes.find("automorph shape star meshes/star.off") != std::string::npos);
    CHECK(shapes.find("automorph figure") == std::string::npos);
}

TEST_CASE(
    "two shapes are generated, inspected and morphed into numbered frames, a correspondence and a report") {
    const TemporaryFolder folder;
    make_shapes(folder);
    const Run info = run_program(folder, "info a.off");
    CHECK(info.status == 0);
    CHECK(info.out.find("can be morphed") != std::string::npos);
    CHECK(info.out.find("closed") != std::string::npos);

    const Run morph = run_program(
        folder, "morph a.off b.ply --frames 4 --out frames/m_.off --correspondence c.csv --report r.json");
    INFO(morph.err);
    REQUIRE(morph.status == 0);
    CHECK(morph.out.find("registration") != std::string::npos);
    CHECK(morph.out.find("\nwritten       frames/m_000.off ... frames/m_003.off\n"
                         "              c.csv\n              r.json\n") != std::string::npos);
    CHECK(names_in(folder / "frames") ==
          std::set<std::string>{"m_000.off", "m_001.off", "m_002.off", "m_003.off"});
    CHECK(names_in(folder.path()) == std::set<std::string>{"a.off", "b.ply", "c.csv", "r.json", "frames"});

    const auto a = automorph::read_mesh(folder / "a.off"), b = automorph::read_mesh(folder / "b.ply");
    const auto first = automorph::read_mesh(folder / "frames/m_000.off");
    const auto last = automorph::read_mesh(folder / "frames/m_003.off");
    CHECK(first.polygon_vertices == last.polygon_vertices);
    CHECK(first.V.rows() > a.V.rows() + b.V.rows());
    // Both ends hold every vertex of their shape.
    for (const auto& [shape, frame] : {std::pair{&a, &first}, std::pair{&b, &last}}) {
        double farthest = 0;
        for (Eigen::Index i = 0; i < shape->V.rows(); ++i) {
            farthest = std::max(farthest, (frame->V.rowwise() - shape->V.row(i)).rowwise().norm().minCoeff());
        }
        CHECK(farthest < 1e-12);
    }
    const std::string csv = content(folder / "c.csv");
    CHECK(csv.rfind("x,y,z\n", 0) == 0);
    CHECK(lines_in(csv) == a.V.rows() + 1);
    CHECK(csv.find("nan") == std::string::npos);
    CHECK(content(folder / "r.json").find("\"rotation\"") != std::string::npos);
}

TEST_CASE("folders that are missing are made, for shapes as for morphs") {
    const TemporaryFolder folder;
    CHECK(run_program(folder, "shape star new/deep/s.off --triangles 300").status == 0);
    CHECK(names_in(folder / "new/deep") == std::set<std::string>{"s.off"});
    CHECK(run_program(folder, "morph new/deep/s.off new/deep/s.off --out out/deep/m.glb -q").status == 0);
    CHECK(names_in(folder / "out/deep") == std::set<std::string>{"m.glb"});
}

TEST_CASE("a numbered frame does not take the place of a mesh that is read") {
    const TemporaryFolder folder;
    REQUIRE(run_program(folder, "shape star s_001.off --triangles 300").status == 0);
    const Run run = run_program(folder, "morph s_001.off s_001.off --out ./s_.off --frames 2");
    CHECK(run.status == 1);
    CHECK(run.err.find("s_001.off: is read, and would be overwritten") != std::string::npos);
    CHECK(run_program(folder, "morph s_001.off s_001.off --out x/s_.off --frames 2").status == 0);
}

TEST_CASE("a morph is written as one animated file, by its extension") {
    const TemporaryFolder folder;
    make_shapes(folder);
    const Run morph =
        run_program(folder, "morph a.off b.ply --out made/m.glb --seconds 3 --ping-pong --up y");
    INFO(morph.err);
    REQUIRE(morph.status == 0);
    CHECK(morph.out.find("written       made/m.glb\n") != std::string::npos);
    CHECK(names_in(folder / "made") == std::set<std::string>{"m.glb"});
    const std::string glb = content(folder / "made/m.glb");
    CHECK(glb.rfind("glTF", 0) == 0);
    CHECK(glb.find("\"name\":\"a to b\"") != std::string::npos);
    CHECK(glb.find("\"max\":[6.0]") != std::string::npos);  // seconds there and back
    CHECK(glb.find("\"generator\":\"automorph ") != std::string::npos);
}

TEST_CASE("info tells what a mesh holds, and by its status whether it can be morphed") {
    const TemporaryFolder folder;
    make_shapes(folder);
    std::ofstream(folder / "fan.off") << "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n"
                                         "3 0 1 2\n3 0 1 3\n3 0 1 4\n";
    const Run bad = run_program(folder, "info a.off fan.off b.ply gone.off");
    CHECK(bad.status == 1);
    CHECK(bad.out.find("1 part, closed, genus 0") != std::string::npos);
    CHECK(bad.out.find("cannot be morphed") != std::string::npos);
    CHECK(bad.out.find("b.ply\n") != std::string::npos);
    CHECK(lines_in(bad.err) == 1);
    const Run json = run_program(folder, "info --json a.off b.ply");
    CHECK(json.status == 0);
    CHECK(json.out.rfind("[\n", 0) == 0);
}

TEST_CASE("help tells of topics and commands, and of nothing else") {
    const TemporaryFolder folder;
    CHECK(run_program(folder, "help output-files").out.find("Line i + 2 is vertex i") != std::string::npos);
    CHECK(run_program(folder, "help morph").out.find("--correspondence") != std::string::npos);
    CHECK(run_program(folder, "help shape head").out == run_program(folder, "shape head --help").out);
    CHECK(run_program(folder, "help shape knitting").status == 1);
    const Run unknown = run_program(folder, "help knitting");
    CHECK(unknown.status == 1);
    CHECK(unknown.err.find("there is no help on 'knitting'") != std::string::npos);
    CHECK(lines_in(unknown.err) == 1);
}

TEST_CASE("results do not depend on the number of threads, and --quiet prints nothing", "[sweep]") {
    const TemporaryFolder folder;
    make_shapes(folder);
    const Run one = run_program(
        folder, "--quiet --threads 1 morph a.off b.ply --frames 2 --out one_.off --correspondence 1.csv");
    const Run two = run_program(
        folder, "morph a.off b.ply --frames 2 --out two_.off --correspondence 2.csv -q --threads 2");
    REQUIRE(one.status == 0);
    REQUIRE(two.status == 0);
    CHECK(one.out + one.err + two.out + two.err == "");
    CHECK(content(folder / "one_001.off") == content(folder / "two_001.off"));
    CHECK(content(folder / "1.csv") == content(folder / "2.csv"));
}

TEST_CASE("a figure is made from a config into out/ and its name") {
    const TemporaryFolder folder;
    make_shapes(folder);
    fs::create_directories(folder / "configs");
    std::ofstream(folder / "configs/tiny.yaml")
        << "source: ../a.off\ntarget: ../b.ply\nrows: [{label: only}]\n"
           "alphas: [0, 1/2]\npicture: {width: 32, height: 32, spp: 8}\n";
    const Run plan = run_program(folder, "figure configs/tiny.yaml --quality draft --dry-run");
    CHECK(plan.status == 0);
    for (const char* phrase : {"out/tiny", "1 x 2 cells of 16 x 16 pixels, 2 paths each",
                               "estimate: ", "(morphs 1 s, checks and maps 1 s, pictures 1 s"}) {
        INFO(phrase);
        CHECK(plan.out.find(phrase) != std::string::npos);
    }
    CHECK_FALSE(fs::exists(folder / "out"));
    const Run figure = run_program(
        folder, "figure configs/tiny.yaml --set video.frames=0 --set picture.spp=1 --set video.turntable=0");
    INFO(figure.err);
    REQUIRE(figure.status == 0);
    const std::set<std::string> expected{"row1-col1.exr", "row1-col1.png", "row1-col2.exr", "row1-col2.png",
                                         "sheet.png",     "metrics.json",  "index.html",    "files.txt"};
    CHECK(names_in(folder / "out/tiny") == expected);
    CHECK(figure.out.find("out/tiny/sheet.png") != std::string::npos);
    CHECK(figure.err.find('\r') == std::string::npos);  // no terminal, no bar
    CHECK(figure.err.find("pictures of row 1 (only): ") != std::string::npos);
    // Pixels per metre, as a cell of 32 of them is four centimetres wide in print.
    const std::string sheet = content(folder / "out/tiny/sheet.png");
    const auto size = sheet.find("pHYs");
    REQUIRE(size + 13 <= sheet.size());
    int per_metre = 0;
    for (std::size_t i = 4; i < 8; ++i)
        per_metre = 256 * per_metre + static_cast<unsigned char>(sheet[size + i]);
    CHECK(std::abs(per_metre - 800) <= 2);
    CHECK(sheet.substr(size + 4, 4) == sheet.substr(size + 8, 4));
    CHECK(sheet[size + 12] == 1);  // the unit is the metre
}

TEST_CASE("what an earlier run made of a figure goes, unless a part of it is made; files of others stay") {
    const TemporaryFolder folder;
    std::ofstream(folder / "f.yaml")
        << "source: {shape: star, triangles: 300}\n"
           "target: {shape: ellipsoid, triangles: 300}\n"
           "rows: [{label: a}, {label: b, alignment: none}]\nalphas: [0, 1/2, 1]\n"
           "picture: {width: 16, height: 16, spp: 1}\n"
           "video: {frames: 0, turntable: 0}\n";
    const auto cells = [](const std::set<std::string>& names) {
        std::set<std::string> found;
        for (const std::string& name : names) {
            if (name.rfind("row", 0) == 0 && fs::path(name).extension() == ".png") found.insert(name);
        }
        return found;
    };
    REQUIRE(run_program(folder, "figure f.yaml --out o").status == 0);
    std::ofstream(folder / "o/row9-col9.png") << "somebody's own";
    const std::set<std::string> all{"row1-col1.png", "row1-col2.png", "row1-col3.png", "row2-col1.png",
                                    "row2-col2.png", "row2-col3.png", "row9-col9.png"};
    CHECK(cells(names_in(folder / "o")) == all);

    const Run part = run_program(folder, "figure f.yaml --out o --rows 2 --cells 1,3");
    REQUIRE(part.status == 0);
    CHECK(part.out.find("kept row1-col1.exr, row1-col1.png, row1-col2.exr and 5 more of an earlier run; "
                        "page and sheet show this run only\n") != std::string::npos);
    CHECK(cells(names_in(folder / "o")) == all);
    CHECK(content(folder / "o/metrics.json").find("\"part\": \"rows 2, cells 1,3\"") != std::string::npos);

    const Run fewer = run_program(folder, "figure f.yaml --out o --set alphas=[0]");
    REQUIRE(fewer.status == 0);
    CHECK(fewer.out.find(
              "removed row1-col2.exr, row1-col2.png, row1-col3.exr and 5 more of an earlier run\n") !=
          std::string::npos);
    CHECK(cells(names_in(folder / "o")) ==
          std::set<std::string>{"row1-col1.png", "row2-col1.png", "row9-col9.png"});

    // A run that fails removes nothing.
    CHECK(run_program(folder, "figure f.yaml --out o --set source.file=gone.off").status == 1);
    CHECK(names_in(folder / "o").size() == 4 + 4 + 1);
}

TEST_CASE("config FILE counts the cells of every kind of figure") {
    const TemporaryFolder folder;
    std::ofstream(folder / "turns.yaml") << "show: shape\nsource: {shape: star}\nturns: [0, 30, 60]\n";
    std::ofstream(folder / "map.yaml") << "show: map\nsource: {shape: ellipsoid}\n";
    CHECK(run_program(folder, "config turns.yaml").out == "turns.yaml: valid, 1 row of 3 cells\n");
    CHECK(run_program(folder, "config map.yaml").out == "map.yaml: valid, 1 row of 2 cells\n");
}

TEST_CASE("a config may come from standard input, with paths relative to the working folder") {
    const TemporaryFolder folder;
    make_shapes(folder);
    std::ofstream(folder / "in.yaml") << "source: a.off\ntarget: b.ply\nrows: [{label: x}]\nalphas: [0]\n";
    const Run plan = run_program(folder, "figure - --dry-run", "in.yaml");
    CHECK(plan.status == 0);
    CHECK(plan.out.find("stdin: would make in out/stdin\n") == 0);
    CHECK(run_program(folder, "config -", "in.yaml").out == "stdin: valid, 1 row of 1 cells\n");
    CHECK(run_program(folder, "config -", "a.off").err.find("automorph: stdin:1:1: ") == 0);
    CHECK(run_program(folder, "config -").err.find("stdin:1:1: found nothing") != std::string::npos);
}

TEST_CASE("findings that cannot be written are an error") {
    const TemporaryFolder folder;
    make_shapes(folder);
    std::ofstream(folder / "a.txt") << "x";
    for (const auto& [arguments, status] : {std::pair<std::string, int>{"info a.off", 1},
                                            {"config --explain", 1},
                                            {"--version", 1},
                                            {"help meshes", 1},
                                            {"shape star s.off", 1},
                                            {"diff a.txt b.ply", 2}}) {
        INFO(arguments);
        const Run run = run_program(folder, arguments + " >/dev/full 2>err.txt #");
        CHECK(run.status == status);
        const std::string told = content(folder / "err.txt");
        CHECK(told.find("automorph: the output cannot be written: ") != std::string::npos);
        CHECK(told.find("report it") == std::string::npos);
    }
}

TEST_CASE("every error is one line on stderr and status 1, and leaves nothing behind") {
    const TemporaryFolder folder;
    make_shapes(folder);
    std::ofstream(folder / "bad.yaml") << "source: a.off\ntarget: b.ply\nrowz: []\n";
    std::ofstream(folder / "gone.yaml")
        << "source: gone.off\ntarget: b.ply\nrows: [{label: x}]\noutput: made\n";
    std::ofstream(folder / "broken.off") << "OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n";
    fs::create_directory(folder / "folder.glb");
    const std::set<std::string> before = names_in(folder.path());
    const auto check = [&](const std::string& arguments, const std::string& phrase) {
        const Run result = run_program(folder, arguments + " -q");
        INFO(arguments);
        INFO(result.err);
        CHECK(result.status == 1);
        CHECK(lines_in(result.err) == 1);
        CHECK(result.out.empty());
        CHECK(result.err.rfind("automorph: ", 0) == 0);
        CHECK(result.err.find(phrase) != std::string::npos);
        std::set<std::string> after = names_in(folder.path());
        after.erase("made");
        CHECK(after == before);
    };
    check("morph gone.off b.ply --out m_.ply", "gone.off");
    check("morph a.off broken.off --out m_.ply", "broken.off:4: ");
    check("morph a.off b.ply --out m_.jpg", "m_.jpg: a morph is written as .glb");
    check("morph a.off b.ply --out m.glb --seconds 0", "--seconds");
    check("completion tcsh", "allowed are bash|fish|zsh");
    check("shape head a.ply --nose-width 9",
          "--nose-width: found '9', allowed are numbers from 0.75 to 1.35");
    check("shape head a.ply --triangles x",
          "--triangles: found 'x', allowed are whole numbers from 64 to 10000000");
    check("morph a.off b.ply --out a.off/m_.ply", "a.off: cannot be used as output folder");
    check("morph a.off b.ply --correspondence a.off/c.csv", "a.off");
    check("morph a.off b.ply --report ./a.off", "./a.off: is read, and would be overwritten");
    check("morph a.off b.ply --out m.glb --report m.glb", "m.glb: would be written twice");
    check("morph a.off b.ply --frames few", "--frames");
    check("morph a.off", "TARGET");
    check("shape star a.off/s.ply", "a.off: cannot be used as output folder");
    check("shape star gone/s.xyz", "gone/s.xyz");
    check("figure bad.yaml", "bad.yaml:3:1: unknown key 'rowz' in the config; did you mean 'rows'?");
    check("figure bad.yaml --set rowz=1 --set picture.spq=2", "--set rowz=1: unknown key 'rowz'");
    check("figure gone.yaml --rows 1-", "--rows '1-': expected");
    check("figure gone.yaml --dry-run --rows 2", "row 2: there are 1");
    check("figure gone.yaml --dry-run", "gone.off");
    check("figure gone.yaml --quality best", "draft|normal|final");
    check("figure gone.yaml", "gone.off");
    check("figure no.yaml", "no.yaml: this config cannot be read: No such file");
    check("config folder.glb", "folder.glb: this config cannot be read: it is a folder");
    check("figure gone.yaml --out a.off/x", "a.off");
    check("info gone.off", "gone.off");
    check("fly", "there is no command 'fly'");
    check("shpe head x.ply", "there is no command 'shpe'; did you mean 'shape'?");
    check("shape had x.ply",
          "there is no command 'had'; did you mean 'head'?; there are ellipsoid, star, head");
    check("morph a.off b.ply --outt m.glb", "there is no option '--outt'; did you mean '--out'?");
    check("morph a.off b.ply c.ply", "'c.ply' is one word too many");
    check("morph a.off b.ply --frames 2 --out m_.ply --frames 3", "--frames is given more than once");
    check("help meshs", "there is no help on 'meshs'; did you mean 'meshes'?");
    check("", "a command is missing");
    check("morph a.off b.ply --out folder.glb", "folder.glb: is a folder");
    check("morph a.off b.ply --out .", ".: is a folder");
    CHECK((!fs::exists(folder / "made") || fs::is_empty(folder / "made")));
}
