#include "render/program/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <map>

#include "render/figure/names.h"

namespace automorph::program {
namespace {

constexpr const char* kAbout =
    "Morphs one triangle mesh into another without any user interaction\n"
    "(Urtasun, Salzmann, Fua 2004) and pictures the result.";

constexpr const char* kExamples = R"(Examples:
  automorph figure configs/fig7.yaml
      makes out/fig7/sheet.png, every cell as EXR and PNG, and metrics.json
  automorph morph a.obj b.obj --frames 5 --out m_.ply
      writes m_000.ply ... m_004.ply, from the first mesh to the second
  automorph morph a.obj b.obj --correspondence c.csv --report r.json
      writes where each vertex of a.obj goes on b.obj, and what was found and used
  automorph shape star star.ply --arms 6
  automorph shape head face.ply --preset asian --crop face --triangles 20000
  automorph info scan.stl
  automorph diff golden/ out/fig7/
      says which pictures have changed, and whether noise explains it
'automorph COMMAND --help' tells more about a command.)";

constexpr const char* kMorphExamples = R"(Examples:
  automorph morph a.obj b.obj --frames 25 --out frames/m_.ply
  automorph morph a.obj b.obj --alignment none --interpolation linear --out plain_.ply
Meshes: .off, .obj, .ply, .stl; open (one border, further openings allowed) or closed, without handles. Vertex i of a.obj goes to line i + 2 of the correspondence, in the coordinates of b.obj.)";

constexpr const char* kFigureExamples = R"(Examples:
  automorph figure configs/fig7.yaml
  automorph figure configs/fig7.yaml --spp 4 --scale 0.5      a quick look
  automorph figure configs/*.yaml --out results               results/fig7, results/heads, ...
'automorph config --explain' lists the keys of a config.)";

template <class E, std::size_t N>
std::map<std::string, E> choices(const std::array<Named<E>, N>& names) {
    std::map<std::string, E> map;
    for (const Named<E>& each : names) map[each.name] = each.value;
    return map;
}

/// "none|registration" instead of CLI11's list of numbers.
template <class E, std::size_t N>
std::string type_name(const std::array<Named<E>, N>& names) {
    std::string text;
    for (const Named<E>& each : names) text += (text.empty() ? "" : "|") + std::string(each.name);
    return text;
}

template <class E, std::size_t N>
void add_choice(CLI::App& command, const std::string& flag, E& value, const std::array<Named<E>, N>& names,
                const std::string& meaning) {
    const std::string fallback = name_of(names, value);
    command
        .add_option_function<std::string>(
            flag,
            [&value, flag, map = choices(names), allowed = type_name(names)](const std::string& text) {
                const auto found = map.find(text);
                if (found == map.end()) {
                    throw CLI::ValidationError(flag,
                                               fmt::format("found '{}', allowed are {}", text, allowed));
                }
                value = found->second;
            },
            meaning)
        ->type_name(type_name(names))
        ->default_str(fallback);
}

void add_figure(CLI::App& app, FigureArguments& arguments) {
    CLI::App* command = app.add_subcommand("figure", "Makes the figures that YAML configs describe");
    command->add_option("CONFIG", arguments.configs, "YAML files")->type_name("FILE")->required();
    command->add_option("--out", arguments.out, "Folder for the results [the config's output, or out/NAME]")
        ->type_name("DIR");
    command->add_option("--spp", arguments.spp, "Light paths per pixel, instead of the config's")
        ->type_name("N")
        ->check(CLI::Range(1, 65536));
    command->add_option("--scale", arguments.scale, "Scales the cells' width and height")
        ->type_name("X")
        ->check(CLI::Range(0.01, 100.0));
    command->add_flag("--layers", arguments.layers,
                      "Cells' EXR with albedo, normals, depth, position, numbers, variance and samples");
    command->footer(kFigureExamples);
}

void add_morph(CLI::App& app, MorphArguments& arguments) {
    CLI::App* command = app.add_subcommand("morph", "Morphs one mesh into another and writes frames");
    command->add_option("SOURCE", arguments.source, "Mesh at alpha = 0")->type_name("MESH")->required();
    command->add_option("TARGET", arguments.target, "Mesh at alpha = 1")->type_name("MESH")->required();
    command->add_option("--frames", arguments.frames, "How many, both ends included")
        ->type_name("N")
        ->check(CLI::Range(2, 100000))
        ->capture_default_str();
    command->add_option("--out", arguments.out, "Frames: m_.ply gives m_000.ply, m_001.ply, ...")
        ->type_name("FILE");
    command
        ->add_option("--correspondence", arguments.correspondence,
                     "CSV: x,y,z on the target per source vertex")
        ->type_name("FILE");
    command->add_option("--report", arguments.report, "JSON: all that was found, used and measured")
        ->type_name("FILE");
    add_choice(*command, "--alignment", arguments.options.alignment, kAlignments,
               "How the maps are brought together");
    add_choice(*command, "--interpolation", arguments.interpolation, kInterpolations, "How vertices move");
    add_choice(*command, "--openings", arguments.options.openings, kOpenings,
               "Openings other than the border (eyes, mouth)");
    add_choice(*command, "--domain", arguments.options.domain, kDomains,
               "What both are mapped onto: auto is the sphere for closed meshes; for open ones the disk, or "
               "the sphere "
               "where the disk squeezes; cut makes two disks of closed ones");
    command->add_flag_callback(
        "--no-lift", [&arguments] { arguments.options.lift = false; },
        "Flat facets instead of curved placement");
    command->add_option("--seed", arguments.options.seed, "Of the registration")
        ->type_name("N")
        ->capture_default_str();
    command->footer(kMorphExamples);
}

void add_shape_options(CLI::App& command, std::filesystem::path& out, ShapeOptions& options) {
    command.add_option("OUT", out, "Mesh file to write")->type_name("FILE")->required();
    command.add_option("--triangles", options.triangles, "How many, about")
        ->check(CLI::Range(64, 10'000'000))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Another seed gives another tessellation")
        ->capture_default_str();
    command.add_option("--scale", options.scale, "Size")
        ->check(CLI::Range(1e-9, 1e12))
        ->capture_default_str();
}

void add_head(CLI::App& shapes, HeadArguments& head) {
    CLI::App* command = shapes.add_subcommand("head", "A human head; every proportion can be changed");
    add_shape_options(*command, head.out, head.options);
    add_choice(*command, "--preset", head.preset, kHeadPresets, "Average or type");
    add_choice(*command, "--crop", head.crop, kHeadCrops,
               "Closed below, cut at the neck, or the face in front of the ears");
    for (std::size_t k = 0; k < kHeadParameters.size(); ++k) {
        const HeadParameter& each = kHeadParameters[k];
        std::string flag = std::string("--") + each.name;
        std::replace(flag.begin(), flag.end(), '_', '-');
        command->add_option(flag, head.proportions[k], std::string(each.meaning) + " [the preset's]")
            ->check(CLI::Range(each.least, each.most))
            ->group("Proportions");
    }
}

void add_shape(CLI::App& app, EllipsoidArguments& round, StarArguments& star, HeadArguments& head) {
    CLI::App* command = app.add_subcommand("shape", "Generates a shape");
    command->require_subcommand(1);
    const CLI::Range positive(1e-9, 1e12);

    CLI::App* ellipsoid = command->add_subcommand("ellipsoid", "An ellipsoid");
    add_shape_options(*ellipsoid, round.out, round.options);
    ellipsoid->add_option("--semi-axes", round.semi_axes, "Half extents in x, y, z")
        ->expected(3)
        ->check(positive)
        ->capture_default_str();

    CLI::App* arms = command->add_subcommand("star", "A smooth solid star in the xy-plane");
    add_shape_options(*arms, star.out, star.options);
    arms->add_option("--arms", star.parameters.arms, "How many")
        ->check(CLI::Range(3, 64))
        ->capture_default_str();
    arms->add_option("--outer", star.parameters.outer, "Radius of the tips")
        ->check(positive)
        ->capture_default_str();
    arms->add_option("--inner", star.parameters.inner, "Radius of the valleys")
        ->check(positive)
        ->capture_default_str();
    arms->add_option("--depth", star.parameters.depth, "Half thickness")
        ->check(positive)
        ->capture_default_str();

    add_head(*command, head);
}

int refuse(const CLI::App& app, const CLI::ParseError& error) {
    std::string command = "automorph";
    for (const CLI::App* sub : app.get_subcommands()) command += " " + sub->get_name();
    std::string message = error.what();
    if (app.get_subcommands().empty() && app.remaining_size() > 0) {
        message = fmt::format("there is no command '{}'", app.remaining().front());
    }
    for (char& c : message) {
        if (c == '\n') c = ' ';
    }
    fmt::print(stderr, "automorph: {} (see '{} --help')\n", message, command);
    return 1;
}

}  // namespace

std::variant<Arguments, int> read_arguments(int count, const char* const* values) {
    CLI::App app(kAbout, "automorph");
    app.set_version_flag("--version", "automorph " AUTOMORPH_VERSION);
    app.footer(kExamples);
    app.require_subcommand(1);
    app.fallthrough();

    Arguments arguments;
    app.add_flag("--quiet,-q", arguments.quiet, "Print errors only");
    app.add_option("--threads", arguments.threads, "How many threads; results do not depend on it [all]")
        ->type_name("N")
        ->check(CLI::Range(1, 4096));

    FigureArguments figure;
    MorphArguments morph;
    EllipsoidArguments ellipsoid;
    StarArguments star;
    HeadArguments head;
    InfoArguments info;
    ConfigArguments config;
    DiffArguments diff;
    add_figure(app, figure);
    add_morph(app, morph);
    add_shape(app, ellipsoid, star, head);
    CLI::App* info_command =
        app.add_subcommand("info", "Tells what a mesh file holds and whether it can be morphed");
    info_command->add_option("MESH", info.meshes, "Mesh files")->type_name("FILE")->required();
    CLI::App* config_command = app.add_subcommand("config", "Explains or checks configs of figures");
    config_command->add_flag("--explain", config.explain, "Print every key with type, default and meaning");
    config_command->add_option("CONFIG", config.checked, "YAML files to check")->type_name("FILE");

    add_diff(app, diff);

    try {
        app.parse(count, values);
    } catch (const CLI::ParseError& error) {
        // Help and version arrive here too.
        if (error.get_exit_code() == 0) return app.exit(error);
        const int status = refuse(app, error);
        return app.got_subcommand("diff") ? static_cast<int>(DiffStatus::CannotCompare) : status;
    }
    CLI::App* shape_command = app.get_subcommand("shape");
    if (app.got_subcommand("figure")) arguments.command = figure;
    if (app.got_subcommand("morph")) arguments.command = morph;
    if (shape_command->got_subcommand("ellipsoid")) arguments.command = ellipsoid;
    if (shape_command->got_subcommand("star")) arguments.command = star;
    if (shape_command->got_subcommand("head")) arguments.command = head;
    if (app.got_subcommand("info")) arguments.command = info;
    if (app.got_subcommand("config")) arguments.command = config;
    if (app.got_subcommand("diff")) arguments.command = diff;
    return arguments;
}

}  // namespace automorph::program
