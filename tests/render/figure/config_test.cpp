#include "render/figure/config.h"

#include <filesystem>
#include <set>
#include <string>

#include "morph/mesh/errors.h"
#include "tests/catch.h"

using namespace automorph;
namespace fs = std::filesystem;

namespace {

// The shortest config there is: line 1 source, line 2 target, line 3 rows.
const std::string kShortest = "source: a.off\ntarget: b.off\nrows: [{label: one}]\n";

FigureConfig parse(const std::string& text) {
    return parse_config(text, "folder/fig.yaml");
}

std::string error_of(const std::string& text) {
    try {
        parse(text);
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "no error";
}

// The error stands at line:column and holds every given phrase.
void check_error(const std::string& text, const std::string& position,
                 const std::vector<std::string>& phrases) {
    const std::string message = error_of(text);
    INFO(text);
    INFO(message);
    CHECK(message.rfind("folder/fig.yaml:" + position + ": ", 0) == 0);
    CHECK(message.find('\n') == std::string::npos);
    for (const std::string& phrase : phrases) {
        INFO("expected in it: " << phrase);
        CHECK(message.find(phrase) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("a config of three lines takes everything else from the defaults") {
    const FigureConfig figure = parse(kShortest);
    CHECK(figure.title.empty());
    CHECK(figure.text == kShortest);
    CHECK(figure.output == fs::path("out/fig"));
    CHECK(figure.alphas == std::vector<double>{0, 0.25, 0.5, 0.75, 1});
    CHECK(figure.seed == 1);
    REQUIRE(figure.rows.size() == 1);
    CHECK(figure.rows[0].label == "one");
    CHECK(figure.rows[0].alignment == Alignment::Registration);
    CHECK(figure.rows[0].interpolation == Interpolation::Slerp);
    CHECK(figure.rows[0].openings == Openings::Reopen);
    CHECK(figure.rows[0].lift);
    CHECK(figure.picture.width == PictureConfig{}.width);
    CHECK(figure.picture.spp == PictureConfig{}.spp);
}

TEST_CASE("paths of a config are relative to its folder, absolute ones stay") {
    const FigureConfig figure =
        parse("source: ../a.off\ntarget: {file: /x/b.ply, fit: false}\nrows: [{label: r}]\noutput: made\n");
    CHECK(figure.source.file == fs::path("a.off"));
    CHECK(figure.target.file == fs::path("/x/b.ply"));
    CHECK(figure.source.fit);
    CHECK_FALSE(figure.target.fit);
    CHECK(figure.output == fs::path("folder/made"));
}

TEST_CASE("a head is a preset with changes, in any order of the keys") {
    const FigureConfig figure =
        parse(R"(source: {proportions: {nose_width: 1.2}, shape: head, preset: asian, crop: face}
target: {shape: head}
rows: [{label: r}]
)");
    HeadParameters expected = head_parameters(HeadPreset::Asian);
    expected.nose_width = 1.2;
    for (const HeadParameter& each : kHeadParameters) {
        CAPTURE(each.name);
        CHECK(figure.source.proportions.*each.member == expected.*each.member);
        CHECK(figure.target.proportions.*each.member == HeadParameters{}.*each.member);
    }
    CHECK(figure.source.crop == HeadCrop::Face);
    CHECK(figure.target.crop == HeadCrop::Closed);
    check_error("source: {shape: star, preset: asian}\n", "1:23",
                {"source.preset has a meaning only beside 'shape: head'"});
    check_error("source: {shape: head, proportions: {nose_width: 3}}\n", "1:49",
                {"source.proportions.nose_width", "3", "0.75", "1.35"});
    check_error("source: {shape: head, proportions: {nose: 1}}\n", "1:37", {"nose"});
}

TEST_CASE("every value of a full config arrives") {
    const FigureConfig figure = parse(R"(title: "A title: with a colon"
source:
  shape: star
  arms: 6
  outer: 2
  inner: 0.5
  depth: 0.25
  triangles: 500
  seed: 18446744073709551615
  rotation: {axis: [0, 1, 0], degrees: -30}
  scale: 2
  translation: [1, -2, 3e-1]
target:
  shape: ellipsoid
  semi_axes: [1, 2, 3]
rows:
  - {label: first, alignment: none, interpolation: linear, openings: fill, domain: cut, lift: false}
  - {label: second, alignment: registration, interpolation: rigid-linear}
  - {label: third, alignment: features}
alphas: [0, 1/3, 0.5, 1]
seed: 7
picture: {width: 100, height: 120, spp: 9, seed: 3, view: [1, 0, 0], up: [0, 0, 1], fov: 35, albedo: [1, 0, 0.5], normals: flat}
)");
    CHECK(figure.title == "A title: with a colon");
    CHECK(figure.source.shape == MeshConfig::Shape::Star);
    CHECK(figure.source.star.arms == 6);
    CHECK(figure.source.star.outer == 2);
    CHECK(figure.source.star.inner == 0.5);
    CHECK(figure.source.star.depth == 0.25);
    CHECK(figure.source.triangles == 500);
    CHECK(figure.source.seed == 18446744073709551615u);
    CHECK(figure.source.rotation.axis == Eigen::Vector3d(0, 1, 0));
    CHECK(figure.source.rotation.degrees == -30);
    CHECK(figure.source.scale == 2);
    CHECK(figure.source.translation == Eigen::Vector3d(1, -2, 0.3));
    CHECK(figure.target.shape == MeshConfig::Shape::Ellipsoid);
    CHECK(figure.target.semi_axes == Eigen::Vector3d(1, 2, 3));
    REQUIRE(figure.rows.size() == 3);
    CHECK(figure.rows[0].alignment == Alignment::None);
    CHECK(figure.rows[2].alignment == Alignment::Features);
    CHECK(figure.rows[0].interpolation == Interpolation::Linear);
    CHECK(figure.rows[0].openings == Openings::Fill);
    CHECK(figure.rows[0].domain == Domain::Cut);
    CHECK(figure.rows[1].domain == Domain::Auto);
    CHECK_FALSE(figure.rows[0].lift);
    CHECK(figure.rows[1].interpolation == Interpolation::RigidLinear);
    CHECK(figure.alphas == std::vector<double>{0, 1.0 / 3, 0.5, 1});
    CHECK(figure.seed == 7);
    CHECK(figure.picture.width == 100);
    CHECK(figure.picture.height == 120);
    CHECK(figure.picture.spp == 9);
    CHECK(figure.picture.seed == 3);
    CHECK(figure.picture.view == Eigen::Vector3d(1, 0, 0));
    CHECK(figure.picture.up == Eigen::Vector3d(0, 0, 1));
    CHECK(figure.picture.fov == 35);
    CHECK(figure.picture.albedo == Eigen::Vector3d(1, 0, 0.5));
    CHECK(figure.picture.normals == render::Normals::Flat);
}

TEST_CASE("an unknown key is refused where it stands, with the nearest known one") {
    check_error(kShortest + "pictures: {}\n", "4:1",
                {"unknown key 'pictures' in the config", "did you mean 'picture'?"});
    check_error(kShortest + "picture:\n  sppp: 4\n", "5:3",
                {"unknown key 'sppp' in picture", "'spp'", "width, height"});
    check_error("source: a\ntarget: b\nrows:\n- label: x\n- lable: y\n", "5:3",
                {"'lable' in rows[1]", "'label'"});
    check_error(kShortest + "completely_else: 1\n", "4:1",
                {"unknown key 'completely_else'", "allowed are title, show, source"});
    check_error("source: {shape: star, rotation: {axes: [1,0,0]}}\n", "1:34",
                {"'axes' in source.rotation", "'axis'"});
}

TEST_CASE("a value of the wrong type is refused where it stands") {
    check_error(kShortest + "picture: {spp: many}\n", "4:16",
                {"picture.spp: found 'many', expected an integer from 1 to 65536"});
    check_error(kShortest + "picture: {spp: \"16\"}\n", "4:16", {"found '16', expected an integer"});
    check_error(kShortest + "picture: {spp: 1.5}\n", "4:16", {"found '1.5', expected an integer"});
    check_error(kShortest + "picture: {fov: [1]}\n", "4:16",
                {"picture.fov: found a list of 1, expected a number"});
    check_error(kShortest + "picture: {fov: .nan}\n", "4:16", {"found '.nan'"});
    check_error(kShortest + "picture: {fov: nan}\n", "4:16", {"found 'nan'"});
    check_error(kShortest + "picture: {fov: 20x}\n", "4:16", {"found '20x'"});
    check_error(kShortest + "picture: 5\n", "4:10", {"picture: found '5', expected a mapping of width"});
    check_error(kShortest + "picture: {view: [1, 2]}\n", "4:17",
                {"found a list of 2, expected a list of 3 numbers"});
    check_error(kShortest + "picture: {view: [1, x, 2]}\n", "4:21", {"picture.view[1]: found 'x'"});
    check_error(kShortest + "alphas: 0\n", "4:9",
                {"alphas: found '0', expected a list of numbers, each from 0 to 1"});
    check_error(kShortest + "alphas: []\n", "4:9", {"found a list of 0"});
    check_error(kShortest + "title: [a]\n", "4:8", {"title: found a list of 1, expected text"});
    check_error(kShortest + "title:\n", "4:1", {"title: found nothing, expected text"});
    check_error("source: a\ntarget: b\nrows: {label: x}\n", "3:7",
                {"rows: expected a list of at least one mapping"});
    check_error("source: a\ntarget: b\nrows: []\n", "3:7", {"rows: expected a list of at least one mapping"});
    check_error("source: a\ntarget: b\nrows: [one]\n", "3:8",
                {"rows[0]: found 'one', expected a mapping of label"});
    check_error("source: a\ntarget: b\nrows: [{label: x, lift: yes}]\n", "3:25",
                {"found 'yes', expected true or false"});
    check_error("source: [a]\ntarget: b\nrows: [{label: x}]\n", "1:9", {"source: found a list of 1"});
    check_error("- a\n- b\n", "1:1",
                {"the config: found a list of 2, expected a mapping of title, show, source"});
}

TEST_CASE("a value outside its range or choice is refused with what is allowed") {
    check_error(kShortest + "picture: {spp: 0}\n", "4:16",
                {"found '0', expected an integer from 1 to 65536"});
    check_error(kShortest + "picture: {spp: -3}\n", "4:16", {"found '-3'"});
    check_error(kShortest + "picture: {albedo: [0, 1, 1.01]}\n", "4:26",
                {"albedo[2]: found '1.01'", "from 0 to 1"});
    check_error(kShortest + "alphas: [0, 1.5]\n", "4:13", {"alphas[1]: found '1.5'", "from 0 to 1"});
    check_error(kShortest + "alphas: [0, 1/0]\n", "4:13", {"alphas[1]: found '1/0'"});
    check_error(kShortest + "alphas: [0, 0.5, 0.5]\n", "4:18",
                {"alphas[2]: found 0.5 after 0.5, expected ascending"});
    check_error(kShortest + "seed: 18446744073709551616\n", "4:7", {"found '18446744073709551616'"});
    check_error("source: a\ntarget: b\nrows: [{label: x, interpolation: slurp}]\n", "3:34",
                {"rows[0].interpolation: found 'slurp', expected one of linear, rigid-linear, slerp",
                 "did you mean 'slerp'?"});
    check_error("source: {shape: cube}\n", "1:17",
                {"source.shape: found 'cube', expected one of ellipsoid, star, head"});
    check_error("source: {shape: ellipsoid, semi_axes: [1, 0, 1]}\n", "1:43", {"semi_axes[1]: found '0'"});
}

TEST_CASE("keys that contradict each other are refused") {
    check_error("source: {file: a.off, shape: star}\ntarget: b\nrows: [{label: x}]\n", "1:9",
                {"source: expected either 'file' or 'shape', found both"});
    check_error("source: {scale: 2}\ntarget: b\nrows: [{label: x}]\n", "1:9", {"found neither"});
    check_error("source: {shape: ellipsoid, arms: 5}\n", "1:28",
                {"source.arms has a meaning only beside 'shape: star'"});
    check_error("source: {file: a.off, triangles: 100}\n", "1:23",
                {"source.triangles has a meaning only beside 'shape'"});
    check_error("source: {shape: star, fit: false}\n", "1:23",
                {"source.fit has a meaning only beside 'file'"});
    check_error("source: {shape: star, inner: 2}\n", "1:23",
                {"source.inner: found 2, expected at most 'outer'"});
    check_error("source: {shape: star, rotation: {axis: [0, 0, 0]}}\n", "1:34",
                {"axis: found a vector of length 0"});
    check_error(kShortest + "picture: {view: [0, 0, 0]}\n", "4:11", {"view: found a vector of length 0"});
    check_error(kShortest + "picture: {view: [0, 0, 3]}\n", "4:11",
                {"picture.up: found a vector parallel to 'view'"});
    check_error(kShortest + "picture: {up: [0, -4, 1]}\n", "4:11",
                {"picture.up: found a vector parallel to 'view'"});
}

TEST_CASE("what a figure shows decides which keys it needs") {
    CHECK(parse("show: map\nsource: a\n").show == Show::Map);
    CHECK(parse("show: borders\nsource: a\ntarget: b\n").show == Show::Borders);
    check_error("show: map\nsource: a\ntarget: b\n", "3:1", {"'target' has no meaning beside 'show: map'"});
    check_error("show: borders\nsource: a\ntarget: b\nrows: [{label: x}]\n", "4:1",
                {"'rows' has no meaning beside 'show: borders'"});
    check_error("show: features\nsource: a\nrows: [{label: x}]\n", "1:1", {"'target' is missing"});
    check_error("show: features\nsource: a\ntarget: b\n", "1:1", {"'rows' is missing"});
}

TEST_CASE("a row sets the constants of its curvature features") {
    const FigureConfig config = parse(
        "source: a\ntarget: b\nrows: [{label: x, alignment: features, features: {scales: [0], targets: "
        "vertices, radius: 0.2, reach: 0.4, rematches: 0}}]\n");
    const AlignOptions options = config.rows[0].morph_options(1).features;
    CHECK(options.matching.scales == std::vector<double>{0.0});
    CHECK(options.matching.targets == FeatureTargets::Vertices);
    CHECK(options.matching.radius == 0.2);
    CHECK(options.matching.largest_difference == FeatureOptions{}.largest_difference);
    CHECK(options.warping.reach == 0.4);
    CHECK(options.rematches == 0);
    check_error("source: a\ntarget: b\nrows: [{label: x, features: {largest_gaussian: 5}}]\n", "3:48",
                {"rows[0].features.largest_gaussian: found '5'"});
}

TEST_CASE("a missing or repeated key is refused") {
    check_error("target: b\nrows: [{label: x}]\n", "1:1", {"'source' is missing in the config", "alpha = 0"});
    check_error("source: a\ntarget: b\n", "1:1", {"'rows' is missing"});
    check_error("source: a\ntarget: b\nrows:\n  - alignment: none\n", "4:5",
                {"'label' is missing in rows[0]"});
    check_error(kShortest + "seed: 1\nseed: 2\n", "5:1", {"'seed' is given twice in the config"});
    check_error("", "1:1", {"found nothing"});
    check_error("# only a comment\n", "1:1", {"found nothing"});
    check_error(kShortest + "---\n" + kShortest, "4:1", {"a second document"});
}

TEST_CASE("broken YAML is refused with its position") {
    check_error("source: [a\n", "2:1", {});
    check_error(kShortest + "\tpicture: 1\n", "4:2", {});
    check_error(kShortest + "picture: *unknown\n", "4:10", {});
}

TEST_CASE("a config that cannot be read is an IoError that names it") {
    REQUIRE_THROWS_AS(load_config("no/such/config.yaml"), IoError);
    REQUIRE_THROWS_AS(load_config(fs::temp_directory_path()), IoError);
    try {
        load_config("no/such/config.yaml");
    } catch (const IoError& error) {
        CHECK(std::string(error.what()).rfind("no/such/config.yaml: ", 0) == 0);
    }
}

TEST_CASE("all shipped configs load") {
    int found = 0;
    for (const auto& entry : fs::directory_iterator(AUTOMORPH_CONFIGS)) {
        if (entry.path().extension() != ".yaml") continue;
        INFO(entry.path().string());
        const FigureConfig figure = load_config(entry.path());
        CHECK_FALSE(figure.title.empty());
        CHECK(figure.output == fs::path("out") / entry.path().stem());
        ++found;
    }
    CHECK(found >= 2);
}

TEST_CASE("the table documents every key once, with a meaning, and its defaults are what a parse gives") {
    std::set<std::string> paths;
    for (const ConfigKey& key : config_keys()) {
        INFO(key.path);
        CHECK(paths.insert(key.path).second);
        CHECK(key.meaning.size() > 10);
        CHECK_FALSE((key.required && !key.fallback.empty()));
        CHECK(explain_config().find(key.path + "\n    " + key.meaning) != std::string::npos);
    }
    for (const char* path :
         {"title", "source.star", "rows[].label", "picture.spp", "target.rotation.axis", "alphas"}) {
        CHECK(paths.count(path) == (std::string(path) != "source.star"));
    }
    // Written out as a config, the defaults of `picture` change nothing.
    std::string text = kShortest + "picture:\n";
    for (const ConfigKey& key : config_keys()) {
        if (key.path.rfind("picture.", 0) == 0)
            text += "  " + key.path.substr(8) + ": " + key.fallback + "\n";
    }
    const PictureConfig written = parse(text).picture, built;
    CHECK(written.width == built.width);
    CHECK(written.view == built.view);
    CHECK(written.albedo == built.albedo);
    CHECK(written.normals == built.normals);
    CHECK(written.fov == built.fov);
}
