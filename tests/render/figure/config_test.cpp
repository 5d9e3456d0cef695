#include "render/figure/config.h"

#include <algorithm>
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
    check_error(kShortest + "video: {shutter: 1.5}\n", "4:18",
                {"video.shutter: found '1.5', expected a number from 0 to 1"});
    check_error(kShortest + "video: {shutter: -0.1}\n", "4:18", {"video.shutter: found '-0.1'"});
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

TEST_CASE("a tab is named where it is to blame") {
    check_error(kShortest + "picture:\n\twidth: 64\n", "5:7", {"line 5 is indented by a tab"});
    CHECK(error_of(kShortest + "picture: {\n").find("tab") == std::string::npos);
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

TEST_CASE("a picture says its material, light, lens, edges, ground, colours, markers and files") {
    const PictureConfig picture = parse(kShortest + R"(picture:
  adaptive: 0.01
  filter: box
  material: {metallic: 1, roughness: 0.25, specular: 0.5, transmission: 0.125, ior: 1.4, emission: [1, 2, 3]}
  light: {kind: sky, map: skies/day.hdr, rotation: -30, strength: 2, visible: true}
  lens: {radius: 0.02, focus: -0.8}
  wireframe: {width: 1.5, color: [1, 0, 0]}
  ground: checker
  color: displacement
  markers: {kind: spread, count: 7, radius: 0.03}
  denoise: true
  curve: filmic
  bits: 16
)")
                                      .picture;
    CHECK(picture.material.metallic == 1);
    CHECK(picture.material.roughness == 0.25);
    CHECK(picture.material.specular == 0.5);
    CHECK(picture.material.transmission == 0.125);
    CHECK(picture.material.ior == 1.4);
    CHECK(picture.material.emission == Eigen::Vector3d(1, 2, 3));
    CHECK(picture.adaptive == 0.01);
    CHECK(picture.filter == render::Filter::Box);
    CHECK(picture.light.kind == LightConfig::Kind::Sky);
    CHECK(picture.light.map == fs::path("folder/skies/day.hdr"));
    CHECK(picture.light.rotation == -30);
    CHECK(picture.light.strength == 2);
    CHECK(picture.light.visible);
    CHECK(picture.lens.radius == 0.02);
    CHECK(picture.lens.focus == -0.8);
    CHECK(picture.wireframe.width == 1.5);
    CHECK(picture.wireframe.color == Eigen::Vector3d(1, 0, 0));
    CHECK(picture.ground == render::Ground::Checker);
    CHECK(picture.color == ColorField::Displacement);
    CHECK(picture.markers.kind == MarkersConfig::Kind::Spread);
    CHECK(picture.markers.count == 7);
    CHECK(picture.markers.radius == 0.03);
    CHECK(picture.denoise);
    CHECK(picture.curve == render::ToneCurve::Filmic);
    CHECK(picture.bits == 16);
    CHECK_FALSE(picture.ends_in_background());
    CHECK(PictureConfig{}.ends_in_background());

    // Short forms.
    const auto ground = [](const std::string& value) {
        return parse(kShortest + "picture: {ground: " + value + "}\n").picture.ground;
    };
    CHECK(ground("true") == render::Ground::Shadow);
    CHECK(ground("false") == render::Ground::None);
    CHECK(ground("shadow") == render::Ground::Shadow);
    CHECK(ground("plain") == render::Ground::Plain);
    const PictureConfig shorter =
        parse(kShortest + "picture: {light: gradient, wireframe: 2, markers: spread}\n").picture;
    CHECK(shorter.light.kind == LightConfig::Kind::Gradient);
    CHECK(shorter.wireframe.width == 2);
    CHECK(shorter.markers.kind == MarkersConfig::Kind::Spread);
}

TEST_CASE("what a picture cannot be is refused where it stands") {
    const auto picture = [](const std::string& keys) { return kShortest + "picture: {" + keys + "}\n"; };
    check_error(picture("material: {ior: 0.9}"), "4:27",
                {"picture.material.ior: found '0.9'", "from 1 to 4"});
    check_error(picture("material: {metal: 1}"), "4:22", {"'metal' in picture.material", "'metallic'"});
    check_error(picture("ground: grass"), "4:19",
                {"picture.ground: found 'grass'", "none, shadow, plain, checker, true, false"});
    check_error(picture("light: sky"), "4:18", {"picture.light.map is missing"});
    check_error(picture("light: {map: x.exr}"), "4:19", {"only beside 'kind: sky'"});
    check_error(picture("light: {kind: gradient, rim: 1}"), "4:35", {"only beside 'kind: studio'"});
    check_error(picture("light: {visible: true}"), "4:19", {"no meaning beside 'kind: studio'"});
    check_error(picture("light: {kind: gradient, visible: true}"), "4:11",
                {"picture.ground: found shadow beside a visible sky"});
    check_error(picture("lens: {focus: 2}"), "4:25", {"picture.lens.focus: found '2'"});
    check_error(picture("wireframe: -1"), "4:22", {"picture.wireframe.width: found '-1'"});
    check_error(picture("bits: 12"), "4:17", {"picture.bits: found '12', expected one of 8, 16"});
    check_error(picture("markers: features"), "4:11", {"no row has 'alignment: features'"});
    check_error(picture("markers: {count: 3}"), "4:21", {"only beside 'kind: spread'"});
    check_error("show: map\nsource: a\npicture: {color: curvature}\n", "3:11",
                {"picture.color has a meaning only beside 'show: morph'"});
}

TEST_CASE("looks and stages begin as the picture, and change what they say") {
    const FigureConfig figure = parse(R"(show: looks
source: a.off
stages:
  - {label: one}
  - {label: two, light: gradient, ground: plain, background: [0.5, 0.5, 0.5]}
looks:
  - {label: a}
  - {label: b, albedo: [1, 0, 0], material: {metallic: 1}, wireframe: 1, normals: flat}
picture: {albedo: [0, 1, 0], material: {roughness: 0.125}, ground: none, spp: 5}
)");
    REQUIRE(figure.looks.size() == 2);
    REQUIRE(figure.stages.size() == 2);
    CHECK(figure.looks[0].label == "a");
    CHECK(figure.looks[0].picture.albedo == Eigen::Vector3d(0, 1, 0));
    CHECK(figure.looks[1].picture.albedo == Eigen::Vector3d(1, 0, 0));
    CHECK(figure.looks[1].picture.material.metallic == 1);
    CHECK(figure.looks[1].picture.material.roughness == 0.125);
    CHECK(figure.looks[1].picture.normals == render::Normals::Flat);
    CHECK(figure.stages[0].picture.ground == render::Ground::None);
    CHECK(figure.stages[1].picture.ground == render::Ground::Plain);
    CHECK(figure.stages[1].picture.light.kind == LightConfig::Kind::Gradient);
    CHECK(figure.stages[1].picture.spp == 5);
    check_error("show: looks\nsource: a\n", "1:1", {"'looks' is missing"});
    check_error("show: looks\nsource: a\ntarget: b\nlooks: [{label: x}]\n", "3:1",
                {"'target' has no meaning beside 'show: looks'"});
    check_error("show: shape\nsource: a\nlooks: [{label: x}]\n", "3:1",
                {"'looks' has no meaning beside 'show: shape'"});
    check_error("show: looks\nsource: a\nlooks: [{label: x, spp: 3}]\n", "3:20",
                {"unknown key 'spp' in looks[0]"});
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
        if (key.path.rfind("picture.", 0) != 0 || !key.only_with.empty()) continue;
        const bool section = key.type == ConfigKey::Type::Section;
        if (key.fallback.empty() && !section) continue;
        const auto depth = static_cast<std::size_t>(std::count(key.path.begin(), key.path.end(), '.'));
        text += std::string(2 * depth, ' ') + key.path.substr(key.path.rfind('.') + 1) + ": " + key.fallback +
                "\n";
    }
    INFO(text);
    const PictureConfig written = parse(text).picture, built;
    CHECK(written.width == built.width);
    CHECK(written.view == built.view);
    CHECK(written.albedo == built.albedo);
    CHECK(written.normals == built.normals);
    CHECK(written.fov == built.fov);
    CHECK(written.ground == built.ground);
    CHECK(written.material.roughness == built.material.roughness);
    CHECK(written.light.kind == built.light.kind);
    CHECK(written.light.strength == built.light.strength);
    CHECK(written.wireframe.color == built.wireframe.color);
    CHECK(written.markers.radius == built.markers.radius);
    CHECK(written.bits == built.bits);
    CHECK(written.filter == built.filter);
    CHECK(written.adaptive == built.adaptive);
}
