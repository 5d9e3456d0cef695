// `automorph diff` as others' CI runs it.
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "render/image/image_file.h"
#include "tests/catch.h"
#include "tests/render/program/run_program.h"

using namespace automorph::render;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

constexpr int kWidth = 40, kHeight = 24, kSamples = 16;

/// A grey ramp with noise of `seed`, as a path tracer would have made it; `factor` makes it brighter.
struct Noisy {
    Image image{kWidth, kHeight};
    Layers layers;

    explicit Noisy(unsigned seed, float factor = 1.0f) {
        layers.albedo = layers.shading_normal = layers.geometric_normal = layers.position = layers.variance =
            Image(kWidth, kHeight);
        layers.depth = layers.object = layers.face = Image(kWidth, kHeight, 1);
        layers.samples = Image(kWidth, kHeight, 1, static_cast<float>(kSamples));
        constexpr float kError = 0.02f;
        std::mt19937 random(seed);
        std::normal_distribution<float> noise(0.0f, kError);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const float ramp = 0.2f + 0.5f * static_cast<float>(i) / static_cast<float>(image.pixels.size());
            image.pixels[i] = factor * ramp + noise(random);
            layers.variance.pixels[i] = kError * kError;
        }
    }
    void write(const fs::path& file) const { write_exr(file, image, layers); }
    void write_plain(const fs::path& file) const { write_exr(file, image); }
};

json report_of(const TemporaryFolder& folder) {
    return json::parse(content(folder / "report.json"));
}

bool holds(const std::string& text, const std::string& phrase) {
    INFO(text);
    INFO("expected: " << phrase);
    const bool found = text.find(phrase) != std::string::npos;
    CHECK(found);
    return found;
}

}  // namespace

TEST_CASE("noise is the same, change is different, by the layers of both pictures") {
    const TemporaryFolder folder;
    Noisy(1).write(folder / "golden.exr");
    Noisy(2).write(folder / "noise.exr");
    Noisy(3, 1.03f).write(folder / "brighter.exr");

    const Run same = run_program(folder, "diff golden.exr noise.exr --report report.json");
    CHECK(same.status == 0);
    CHECK(same.err.empty());
    holds(same.out, "same (statistical, false alarms at most 1 %): noise.exr\n");
    holds(same.out, "seen would have been: ");
    CHECK(report_of(folder)["verdict"] == "same");

    const Run different = run_program(folder,
                                      "diff golden.exr brighter.exr --report report.json "
                                      "--heatmap heat.png --side-by-side beside.png");
    CHECK(different.status == 1);
    CHECK(different.err.empty());
    CHECK(different.out.rfind("DIFFERENT (statistical, false alarms at most 1 %): whole picture ", 0) == 0);
    const json report = report_of(folder);
    CHECK(report["verdict"] == "different");
    CHECK(report["status"] == 1);
    CHECK(report["different"] == 1);
    const json& picture = report["pictures"][0];
    CHECK(picture["name"] == "brighter.exr");
    CHECK(picture["mode"] == "statistical");
    bool found = false;
    for (const json& test : picture["tests"]) {
        if (test["name"] != "whole picture") continue;
        found = true;
        CHECK(test["passed"] == false);
        CHECK(test["value"] > test["limit"]);
        CHECK(test["new"].get<double>() / test["golden"].get<double>() == Approx(1.03).margin(0.004));
        CHECK(test["where"]["width"] == kWidth);
        CHECK(test["chance"] < 0.01);
    }
    CHECK(found);
    CHECK(picture["sensitivity"]["even_change"] < 0.02);
    CHECK(read_image(folder / "heat.png").image.width >= 320);
    CHECK(read_image(folder / "beside.png").image.width >= 3 * 320);
}

TEST_CASE("modes are chosen by what the files hold, and said") {
    const TemporaryFolder folder;
    Noisy(1).write(folder / "layers.exr");
    Noisy(1).write_plain(folder / "plain.exr");
    Noisy(2).write_plain(folder / "other.exr");
    write_png(folder / "golden.png", Noisy(1).image);
    write_png(folder / "other.png", Noisy(2).image);

    holds(run_program(folder, "diff layers.exr plain.exr").out, "same (same-seed): plain.exr");
    CHECK(run_program(folder, "diff layers.exr plain.exr").status == 0);
    holds(run_program(folder, "diff plain.exr other.exr").out, "DIFFERENT (same-seed): rmse ");
    CHECK(run_program(folder, "diff plain.exr other.exr").status == 1);
    CHECK(run_program(folder, "diff plain.exr other.exr --rmse 0.1").status == 0);
    CHECK(run_program(folder, "diff plain.exr other.exr --rmse 0.1 --outlier 0.01").status == 1);
    CHECK(run_program(folder, "diff plain.exr other.exr --rmse 0.1 --outlier 0.01 --outliers 960").status ==
          0);
    CHECK(run_program(folder, "diff golden.png other.png").status == 1);
    holds(run_program(folder, "diff plain.exr other.exr --mode exact").out,
          "values that differ 2880 (limit 0)");
    CHECK(run_program(folder, "diff plain.exr golden.png --rmse 0.003").status == 0);  // 8 bits

    fs::copy_file(folder / "plain.exr", folder / "copy.exr");
    CHECK(run_program(folder, "diff plain.exr copy.exr --mode exact").status == 0);
    Noisy changed(1);
    changed.image.at(7, 9)[1] = std::nextafter(changed.image.at(7, 9)[1], 1.0f);
    changed.write_plain(folder / "bit.exr");
    const Run bit = run_program(folder, "diff plain.exr bit.exr --mode exact");
    CHECK(bit.status == 1);
    holds(bit.out, "values that differ 1 (limit 0) at x 7, y 9, G");
    CHECK(run_program(folder, "diff plain.exr bit.exr").status == 0);

    changed = Noisy(1);
    changed.image.at(7, 9)[1] = std::numeric_limits<float>::quiet_NaN();
    changed.write_plain(folder / "nan.exr");
    holds(run_program(folder, "diff plain.exr nan.exr").out, " to nan\n");
    CHECK(run_program(folder, "diff plain.exr nan.exr").status == 1);

    changed = Noisy(1);
    *changed.layers.face.at(3, 3) = 5.0f;  // a layer that only the exact mode looks at
    changed.write(folder / "face.exr");
    holds(run_program(folder, "diff layers.exr face.exr --mode exact").out, "at x 3, y 3, face.id");
    CHECK(run_program(folder, "diff layers.exr face.exr").status == 0);
}

TEST_CASE("what cannot be compared has status 2 and one line that says why") {
    const TemporaryFolder folder;
    Noisy(1).write(folder / "layers.exr");
    Noisy(1).write_plain(folder / "plain.exr");
    write_exr(folder / "small.exr", Image(8, 8));
    write_exr(folder / "grey.exr", Image(kWidth, kHeight, 1));
    Noisy once(1);
    *once.layers.samples.at(3, 2) = 1.0f;
    once.write(folder / "once.exr");
    std::ofstream(folder / "broken.exr") << "no picture";
    fs::create_directories(folder / "empty");
    fs::create_directories(folder / "nothing");
    const auto check = [&](const std::string& arguments, const std::string& phrase) {
        const Run result = run_program(folder, "diff " + arguments);
        INFO(arguments);
        INFO(result.err);
        CHECK(result.status == 2);
        CHECK(lines_in(result.err) == 1);
        CHECK(result.err.rfind("automorph: ", 0) == 0);
        CHECK(result.err.find(phrase) != std::string::npos);
    };
    const Run quiet = run_program(folder, "diff -q plain.exr gone.exr");
    CHECK(quiet.err == run_program(folder, "diff plain.exr gone.exr").err);
    CHECK(quiet.out.empty());
    check("plain.exr gone.exr", "gone.exr: missing");
    check("lost.exr gone.exr", "lost.exr and gone.exr: there are no such files");
    check("gone.exr plain.exr", "there is no golden gone.exr");
    check("plain.exr broken.exr", "broken.exr: ");
    check("plain.exr small.exr", "40 x 24 with 3 channels against 8 x 8 with 3");
    check("plain.exr grey.exr", "channels");
    check("plain.exr layers.exr --mode exact", "channels differ: R G B against R G B albedo.R");
    check("layers.exr plain.exr --mode statistical",
          "plain.exr: there are no layers 'variance' and 'samples'");
    check("layers.exr once.exr", "pixel (3, 2) of the new picture has 1 samples");
    check("plain.exr plain.exr", "given as golden and as new");
    check("plain.exr layers.exr --heatmap plain.exr", "plain.exr: is read, and would be overwritten");
    check("plain.exr layers.exr --heatmap h.png --side-by-side h.png", "h.png: would be written twice");
    check("plain.exr empty", "give two files");
    check("nothing empty", "there is no .exr or .png file");
    check("plain.exr", "NEW");
    check("plain.exr layers.exr --mode magic", "allowed are auto|exact|same-seed|statistical");
    check("plain.exr layers.exr --report plain.exr/r.json", "plain.exr");
    CHECK(run_program(folder, "diff --help").status == 0);
}

TEST_CASE("folders are compared file by file, with missing and further ones told") {
    const TemporaryFolder folder;
    for (const char* each : {"golden/sub", "new/sub"}) fs::create_directories(folder / each);
    Noisy(1).write(folder / "golden/a.exr");
    Noisy(2).write(folder / "new/a.exr");
    Noisy(3).write(folder / "golden/sub/b.exr");
    Noisy(4, 1.1f).write(folder / "new/sub/b.exr");
    write_png(folder / "golden/c.png", Noisy(5).image);
    write_png(folder / "new/c.png", Noisy(5).image);
    std::ofstream(folder / "new/notes.txt") << "no picture";
    std::ofstream(folder / "new/.half.exr") << "being written";

    const Run run =
        run_program(folder, "diff golden new --side-by-side why/s --heatmap why/h --report report.json");
    INFO(run.out);
    CHECK(run.status == 1);
    CHECK(run.out.rfind("DIFFERENT: of 3 pictures 2 are the same, 1 differs (false alarms at most 1 %)\n",
                        0) == 0);
    holds(run.out, "statistical  whole picture");
    holds(run.out, "same-seed    rmse");
    CHECK(names_in(folder / "why/s") == std::set<std::string>{"sub"});
    CHECK(names_in(folder / "why/s/sub") == std::set<std::string>{"b.exr.png"});
    CHECK(names_in(folder / "why/h/sub") == std::set<std::string>{"b.exr.png"});
    const json report = report_of(folder);
    REQUIRE(report["pictures"].size() == 3);
    CHECK(report["pictures"][0]["name"] == "a.exr");
    CHECK(report["pictures"][0]["verdict"] == "same");
    CHECK(report["pictures"][1]["mode"] == "same-seed");
    CHECK(report["pictures"][2]["name"] == "sub/b.exr");
    CHECK(report["pictures"][2]["verdict"] == "different");
    // The run's share of false alarms is divided among the pictures that are compared: limits are higher.
    run_program(folder, "diff golden/a.exr new/a.exr --report alone.json");
    CHECK(report["pictures"][0]["tests"][0]["limit"].get<double>() >
          json::parse(content(folder / "alone.json"))["pictures"][0]["tests"][0]["limit"].get<double>() +
              0.1);

    Noisy(3).write(folder / "new/sub/b.exr");
    CHECK(run_program(folder, "diff golden new --side-by-side why/s").status == 0);
    CHECK(names_in(folder / "why/s/sub").empty());  // nothing of an earlier run
    CHECK(names_in(folder / "why/h/sub").size() == 1);
    Noisy(4, 1.1f).write(folder / "new/sub/b.exr");

    fs::remove(folder / "new/a.exr");
    Noisy(6).write(folder / "new/d.exr");
    const Run uneven = run_program(folder, "diff golden new --report report.json");
    CHECK(uneven.status == 2);
    CHECK(lines_in(uneven.err) == 2);
    holds(uneven.out, "CANNOT COMPARE: of 4 pictures 1 is the same, 1 differs, 2 cannot be compared");
    holds(uneven.err, "new/a.exr: missing");
    holds(uneven.err, "new/d.exr: there is no golden golden/d.exr");
    CHECK(report_of(folder)["not_compared"] == 2);
    holds(report_of(folder)["pictures"][0]["reason"].get<std::string>(), "missing");
}

TEST_CASE("--accept replaces what differs, adds what is new and touches nothing else") {
    const TemporaryFolder folder;
    for (const char* each : {"golden", "new/sub"}) fs::create_directories(folder / each);
    Noisy(1).write(folder / "golden/noise.exr");
    Noisy(2).write(folder / "new/noise.exr");
    Noisy(3).write(folder / "golden/changed.exr");
    Noisy(4, 1.1f).write(folder / "new/changed.exr");
    Noisy(5).write(folder / "golden/gone.exr");
    Noisy(6).write(folder / "new/sub/added.exr");
    const std::string noise = content(folder / "golden/noise.exr"),
                      gone = content(folder / "golden/gone.exr");

    SECTION("folders") {
        const Run run = run_program(folder, "diff golden new --accept");
        INFO(run.err);
        CHECK(run.status == 0);
        CHECK(run.out ==
              "replaced  golden/changed.exr\n"
              "kept      golden/gone.exr, which is not among the new pictures\n"
              "added     golden/sub/added.exr\n"
              "accepted 2 of 4 pictures\n");
        CHECK(content(folder / "golden/changed.exr") == content(folder / "new/changed.exr"));
        CHECK(content(folder / "golden/sub/added.exr") == content(folder / "new/sub/added.exr"));
        CHECK(content(folder / "golden/noise.exr") == noise);
        CHECK(content(folder / "golden/gone.exr") == gone);
        CHECK(names_in(folder / "golden") ==
              std::set<std::string>{"changed.exr", "gone.exr", "noise.exr", "sub"});
    }
    SECTION("all that is not equal to the last bit, if asked for") {
        CHECK(run_program(folder, "diff golden new --accept --mode exact").status == 0);
        CHECK(content(folder / "golden/noise.exr") == content(folder / "new/noise.exr"));
    }
    SECTION("two files, the golden being new or not") {
        CHECK(run_program(folder, "diff golden/changed.exr new/changed.exr --accept -q").status == 0);
        CHECK(run_program(folder, "diff fresh/first.exr new/noise.exr --accept -q").status == 0);
        CHECK(content(folder / "golden/changed.exr") == content(folder / "new/changed.exr"));
        CHECK(content(folder / "fresh/first.exr") == content(folder / "new/noise.exr"));
        CHECK(run_program(folder, "diff golden/changed.exr new/nothing.exr --accept -q").status == 2);
        const Run other = run_program(folder, "diff golden/changed.png new/changed.exr --accept");
        CHECK(other.status == 2);
        holds(other.err, "new/changed.exr: cannot be copied over golden/changed.png");
        CHECK(names_in(folder / "golden").count("changed.png") == 0);
    }
    SECTION("nothing at all if one of the new pictures is broken, or by a plain comparison") {
        std::ofstream(folder / "new/zebra.exr") << "no picture";
        const std::string before = content(folder / "golden/changed.exr");
        const Run run = run_program(folder, "diff golden new --accept");
        CHECK(run.status == 2);
        CHECK(lines_in(run.err) == 1);
        holds(run.err, "zebra.exr");
        CHECK(run_program(folder, "diff golden new").status == 2);
        CHECK(content(folder / "golden/changed.exr") == before);
        CHECK(names_in(folder / "golden") == std::set<std::string>{"changed.exr", "gone.exr", "noise.exr"});
    }
}

TEST_CASE("figures written with layers are compared by their noise") {
    const TemporaryFolder folder;
    REQUIRE(run_program(folder, "shape ellipsoid a.off --triangles 300").status == 0);
    const auto config = [&](int seed, const char* albedo) {
        std::ofstream(folder / "c.yaml")
            << "source: a.off\nshow: shape\nturns: [0]\n"
            << "picture: {width: 32, height: 32, spp: 32, seed: " << seed << ", albedo: " << albedo << "}\n";
    };
    config(1, "[0.7, 0.7, 0.7]");
    const Run figure = run_program(folder, "figure c.yaml --layers --out golden -q");
    INFO(figure.err);
    REQUIRE(figure.status == 0);
    config(2, "[0.7, 0.7, 0.7]");
    REQUIRE(run_program(folder, "figure c.yaml --layers --out noise -q").status == 0);
    config(2, "[0.8, 0.7, 0.7]");
    REQUIRE(run_program(folder, "figure c.yaml --layers --out change -q").status == 0);
    const Run noise = run_program(folder, "diff golden/row1-col1.exr noise/row1-col1.exr");
    CHECK(noise.status == 0);
    holds(noise.out, "same (statistical");
    const Run change = run_program(folder, "diff golden/row1-col1.exr change/row1-col1.exr");
    CHECK(change.status == 1);
    holds(change.out, "red");
}
