#include <filesystem>
#include <fstream>
#include <string>

#include "morph/mesh/errors.h"
#include "render/figure/config.h"
#include "render/figure/quality.h"
#include "render/figure/selection.h"
#include "tests/catch.h"
#include "tests/files.h"

// What a config is made of besides its own text: configs it extends, keys from the command line, qualities.

using namespace automorph;
namespace fs = std::filesystem;

namespace {

const std::string kShortConfig = "source: a.off\ntarget: b.off\nrows: [{label: one}]\n";

void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

std::string error_of_file(const fs::path& file, const std::vector<std::string>& overrides = {}) {
    try {
        load_config(file, overrides);
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "no error";
}

std::string override_error(const std::string& text) {
    try {
        parse_config(kShortConfig, "fig.yaml", {text});
    } catch (const ConfigError& error) {
        return error.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("a config takes over the keys of the one it extends, mappings key by key") {
    const TemporaryFolder folder;
    write(folder / "shared/base.yaml",
          "# shared\nsource: a.off\ntarget: {shape: star, arms: 7}\nalphas: [0, 1]\n"
          "rows: [{label: base}]\npicture: {width: 100, spp: 8}\n");
    write(folder / "middle.yaml", "extends: shared/base.yaml\npicture: {spp: 16}\ntitle: Middle\n");
    write(folder / "top.yaml",
          "extends: middle.yaml\nrows: [{label: x}, {label: y}]\ntarget: {arms: 9}\npicture: {height: 50}\n");
    const FigureConfig config = load_config(folder / "top.yaml");
    CHECK(config.title == "Middle");
    CHECK(config.source.file == folder / "shared/a.off");  // relative to the file it stands in
    CHECK(config.target.star.arms == 9);
    CHECK(config.target.shape == MeshConfig::Shape::Star);
    CHECK(config.alphas == std::vector<double>{0, 1});
    CHECK(config.rows.size() == 2);
    CHECK(config.picture.width == 100);
    CHECK(config.picture.height == 50);
    CHECK(config.picture.spp == 16);
    REQUIRE(config.bases.size() == 2);
    CHECK(config.bases[0].file == folder / "middle.yaml");
    CHECK(config.bases[1].file == folder / "shared/base.yaml");
    CHECK(config.bases[1].text.rfind("# shared\n", 0) == 0);
    CHECK(config.output == fs::path("out/top"));
}

TEST_CASE("errors name file, line and column of the text that is wrong") {
    const TemporaryFolder folder;
    const std::string base = (folder / "base.yaml").string(), top = (folder / "top.yaml").string();
    write(top, "extends: base.yaml\n\n\ntitle: T\n");
    write(base, kShortConfig + "picture: {spp: 0}\n");
    CHECK(error_of_file(top).rfind(base + ":4:16: picture.spp: found '0'", 0) == 0);
    write(base, kShortConfig + "picture: {spq: 1}\n");
    CHECK(error_of_file(top).rfind(base + ":4:11: unknown key 'spq' in picture; did you mean 'spp'?", 0) ==
          0);
    write(base, kShortConfig + "picture: [\n");
    CHECK(error_of_file(top).rfind(base + ":", 0) == 0);
    write(base, kShortConfig + "seed: 1\nseed: 2\n");
    CHECK(error_of_file(top).rfind(base + ":5:1: 'seed' is given twice", 0) == 0);
    write(base, kShortConfig + "picture: {width: 20}\n");
    write(top, "extends: base.yaml\npicture:\n  sqq: 1\n");
    CHECK(error_of_file(top).rfind(top + ":3:3: unknown key 'sqq'", 0) == 0);
    write(top, "extends: base.yaml\nshow: map\n");
    CHECK(error_of_file(top).rfind(base + ":2:1: 'target' has no meaning", 0) == 0);
    write(top, "extends: gone.yaml\n");
    CHECK(error_of_file(top).rfind(top + ":1:10: extends: " + (folder / "gone.yaml").string(), 0) == 0);
    write(top, "extends: [base.yaml]\nsource: a\n");
    CHECK(error_of_file(top).rfind(top + ":1:10: extends: found a list of 1, expected a path", 0) == 0);
    write(base, "- a\n");
    write(top, "extends: base.yaml\n");
    CHECK(error_of_file(top).rfind(top + ":1:10: extends: ", 0) == 0);
}

TEST_CASE("a config that extends itself, directly or not, is refused with the way") {
    const TemporaryFolder folder;
    write(folder / "a.yaml", "extends: b.yaml\n");
    write(folder / "b.yaml", "# b\nextends: sub/../a.yaml\n");
    CHECK(error_of_file(folder / "a.yaml") == (folder / "b.yaml").string() +
                                                  ":2:10: extends: a config cannot extend itself: a.yaml -> "
                                                  "b.yaml -> a.yaml");
    write(folder / "self.yaml", "extends: self.yaml\n");
    CHECK(error_of_file(folder / "self.yaml").find("self.yaml -> self.yaml") != std::string::npos);
}

TEST_CASE("aliases, which merging would change in all their places, are refused beside extends") {
    const TemporaryFolder folder;
    write(folder / "base.yaml", "target: {shape: star, triangles: 500}\nrows: [{label: x}]\n");
    const std::string aliases = "source: &s {shape: star, arms: 6}\ntarget: *s\n";
    write(folder / "top.yaml", "extends: base.yaml\n" + aliases);
    CHECK(error_of_file(folder / "top.yaml").rfind((folder / "top.yaml").string() + ":3:9: an alias", 0) ==
          0);
    CHECK(parse_config(aliases + "rows: [{label: x}]\n", "a.yaml").target.star.arms == 6);
    // The config that is extended may hold them.
    write(folder / "base.yaml", aliases + "rows: [{label: x}]\n");
    write(folder / "top.yaml", "extends: base.yaml\ntarget: {shape: ellipsoid}\nsource: {arms: 7}\n");
    CHECK(
        error_of_file(folder / "top.yaml").rfind((folder / "base.yaml").string() + ":1:26: target.arms", 0) ==
        0);
    write(folder / "top.yaml", "extends: base.yaml\nsource: {arms: 7}\n");
    const FigureConfig config = load_config(folder / "top.yaml");
    CHECK(config.source.star.arms == 7);
    CHECK(config.target.star.arms == 6);
}

TEST_CASE("keys are set from the command line by their paths, checked by the same table") {
    const FigureConfig config = parse_config(
        kShortConfig, "folder/fig.yaml",
        {"picture.spp=16", "rows[0].domain=disk", "alphas=[0, 1/3, 1]", "source={shape: star}",
         "source.arms=9", "picture.spp=32", "title=a = b", "rows[0].features.radius=0.4", "target=x/c.off"});
    CHECK(config.picture.spp == 32);
    CHECK(config.rows[0].domain == Domain::Disk);
    CHECK(config.rows[0].features.matching.radius == 0.4);
    CHECK(config.alphas == std::vector<double>{0, 1.0 / 3, 1});
    CHECK(config.source.star.arms == 9);
    CHECK(config.title == "a = b");
    CHECK(config.target.file == fs::path("x/c.off"));  // relative to the working directory
    CHECK(config.overrides.size() == 9);

    CHECK(override_error("picture.spp=0") ==
          "--set picture.spp=0: picture.spp: found '0', expected an integer from 1 to 65536");
    CHECK(override_error("picture.spq=1")
              .rfind("--set picture.spq=1: unknown key 'spq' in picture; did you mean "
                     "'spp'?",
                     0) == 0);
    CHECK(override_error("pictures.spp=1").rfind("--set pictures.spp=1: unknown key 'pictures'", 0) == 0);
    CHECK(override_error("rows[1].label=x").find("it has 1, counted from 0") != std::string::npos);
    CHECK(override_error("source.fit=false").find("source is no mapping here") != std::string::npos);
    CHECK(override_error("title[0]=x").find("title") != std::string::npos);
    CHECK(override_error("picture.spp=") == "--set picture.spp=: there is no value");
    CHECK(override_error("extends=x.yaml").rfind("--set extends=x.yaml: ", 0) == 0);
    CHECK(override_error("picture.spp=[").rfind("--set picture.spp=[: ", 0) == 0);
    for (const char* wrong :
         {"picture.spp", "=5", "picture.=5", ".spp=5", "rows[=1", "rows[0]x=1", "[0]=1", "rows[x].label=1"}) {
        INFO(wrong);
        CHECK(override_error(wrong).rfind(std::string("--set ") + wrong + ": ", 0) == 0);
    }
}

TEST_CASE("an error about a key that the command line set anew tells of the command line") {
    const std::string override = "picture.view=[0, 0, 0]";
    std::string message;
    try {
        parse_config(kShortConfig + std::string("picture: {view: [0, 1, 0], spp: 4}\n"), "a.yaml",
                     {override});
    } catch (const ConfigError& error) {
        message = error.what();
    }
    CHECK(message == "--set " + override + ": picture.view: found a vector of length 0");
}

TEST_CASE("the hash of a config changes with its text, what it extends and what is set") {
    const FigureConfig plain = parse_config(kShortConfig, "a.yaml");
    CHECK(config_hash(plain).size() == 24);
    CHECK(config_hash(plain).rfind("fnv1a64:", 0) == 0);
    CHECK(config_hash(plain) == config_hash(parse_config(kShortConfig, "elsewhere/b.yaml")));
    CHECK(config_hash(plain) != config_hash(parse_config(kShortConfig + "#\n", "a.yaml")));
    CHECK(config_hash(plain) != config_hash(parse_config(kShortConfig, "a.yaml", {"seed=1"})));
    // FNV-1a's own test vector: "a" is af63dc4c8601ec8c; the end of the text adds a byte ff.
    FigureConfig one;
    one.text = "a";
    const std::uint64_t expected = (0xaf63dc4c8601ec8cu ^ 0xffu) * 0x100000001b3u;
    CHECK(std::stoull(config_hash(one).substr(8), nullptr, 16) == expected);
}

TEST_CASE("a selection is numbers and ranges from 1") {
    const Selection some("1,3-4");
    CHECK(some.has(0));
    CHECK_FALSE(some.has(1));
    CHECK(some.has(2));
    CHECK(some.has(3));
    CHECK_FALSE(some.has(4));
    CHECK(Selection().has(1000));
    CHECK_NOTHROW(some.check(4, "row"));
    CHECK_THROWS_AS(some.check(3, "row"), ConfigError);
    for (const char* wrong :
         {"", "0", "a", "1,", "2-1", "1-", "-2", "1 2", "1-2-3", "99999999999999999999999"}) {
        INFO(wrong);
        CHECK_THROWS_AS(Selection(wrong), ConfigError);
    }
}

TEST_CASE("a draft costs a fraction of the normal quality, the final one a multiple") {
    const FigureConfig normal = parse_config(kShortConfig, "a.yaml");
    const auto cost = [](const FigureConfig& config) {
        const double cell = 1.0 * config.picture.width * config.picture.height * config.picture.spp;
        const double frame = 1.0 * config.video.size * config.video.size * config.video.spp;
        return std::pair{cell, frame * (config.video.frames + config.video.turntable)};
    };
    FigureConfig draft = normal, same = normal, final = normal;
    apply_quality(Quality::Draft, draft);
    apply_quality(Quality::Normal, same);
    apply_quality(Quality::Final, final);
    CHECK(cost(same) == cost(normal));
    CHECK(cost(draft).first < cost(normal).first / 30);
    CHECK(cost(draft).second < cost(normal).second / 30);
    CHECK(draft.video.turntable == 0);
    CHECK(final.picture.width == 2 * normal.picture.width);
    CHECK(cost(final).first == 16 * cost(normal).first);
    CHECK(draft.video.frames / draft.video.fps == Approx(normal.video.frames / normal.video.fps));
}
