#include "render/program/arguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>

#include "render/figure/names.h"
#include "render/figure/suggestion.h"
#include "render/program/command_tree.h"
#include "render/program/option_groups.h"
#include "render/program/text_commands.h"
#include "render/program/version.h"

namespace automorph::program {
namespace {

constexpr const char* kAbout =
    "Morphs one triangle mesh into another without any user interaction\n"
    "(Urtasun, Salzmann, Fua 2004) and pictures the result.";

constexpr const char* kExamples = R"(Examples:
  automorph figure configs/fig7.yaml
      makes out/fig7/index.html, a page of it, sheet.png, every cell as EXR and PNG, videos and metrics.json
  automorph morph a.obj b.obj --frames 5 --out m_.ply
      writes m_000.ply ... m_004.ply, from the first mesh to the second
  automorph morph a.obj b.obj --correspondence c.csv --report r.json
      writes where each vertex of a.obj goes on b.obj, and what was found and used
  automorph turntable head.ply --out turn.mp4
      a video of the mesh turning; with a second mesh, of the morph
  automorph shape star star.ply --arms 6
  automorph shape head face.ply --preset asian --crop face --triangles 20000
  automorph info scan.stl
  automorph diff golden/ out/fig7/
      says which pictures have changed, and whether noise explains it
  automorph help getting-started
'automorph COMMAND --help' tells more about a command.)";

constexpr const char* kMorphExamples = R"(Examples:
  automorph morph a.obj b.obj --frames 25 --out frames/m_.ply
  automorph morph a.obj b.obj --out m.glb --seconds 3 --ping-pong       for Blender, three.js, viewers
  automorph morph a.obj b.obj --alignment none --interpolation linear --out plain_.ply
Meshes: .off, .obj, .ply, .stl; open (one border, further openings allowed) or closed, without handles. Vertex i of a.obj goes to line i + 2 of the correspondence, in the coordinates of b.obj.)";

constexpr const char* kFigureExamples = R"(Examples:
  automorph figure configs/fig7.yaml
  automorph figure configs/fig7.yaml --quality draft          a quick look
  automorph figure configs/fig7.yaml --rows 2 --cells 1,3-5 --set picture.spp=256
  automorph figure configs/fig7.yaml --quality final --dry-run
  automorph figure configs/*.yaml --out results               results/fig7, results/heads, ...
'automorph config --explain' lists the keys of a config.)";

constexpr const char* kConfigExamples = R"(Examples:
  automorph config --explain | less
  automorph config my.yaml                     checks it and makes nothing
  automorph config --schema > schema.json      for editors: '# yaml-language-server: $schema=schema.json' in my.yaml)";

constexpr std::array kUpAxes{Named<UpAxis>{"z", UpAxis::Z}, Named<UpAxis>{"y", UpAxis::Y}};

constexpr std::array kLogLevels{
    Named<LogLevel>{"error", LogLevel::Error}, Named<LogLevel>{"warning", LogLevel::Warning},
    Named<LogLevel>{"info", LogLevel::Info}, Named<LogLevel>{"debug", LogLevel::Debug}};

void add_figure(CLI::App& app, FigureArguments& arguments) {
    CLI::App* command = app.add_subcommand("figure", "Makes the figures that YAML configs describe");
    command->add_option("CONFIG", arguments.configs, "YAML files; - reads one from standard input")
        ->type_name("YAML")
        ->required();
    command->add_option("--out", arguments.out, "Folder for the results [the config's output, or out/NAME]")
        ->type_name("DIR");
    command->add_option("--spp", arguments.spp, "Light paths per pixel, instead of the config's")
        ->type_name("N")
        ->check(range(1, 65536));
    command->add_option("--scale", arguments.scale, "Scales the cells' width and height")
        ->type_name("X")
        ->check(range(0.01, 100.0));
    add_choice(*command, "--quality", arguments.quality, kQualities,
               "draft: half the size, few paths, denoised, no turntable; final: twice the size, four times "
               "the paths");
    command
        ->add_option("--rows", arguments.rows,
                     "Only these rows, counted from 1; the camera stays that of all")
        ->type_name("1,3-4");
    command->add_option("--cells", arguments.cells, "Only these columns, counted from 1")->type_name("1-3");
    command->add_option("--frames", arguments.frames, "Only these frames of the videos, counted from 1")
        ->type_name("A-B");
    command
        ->add_option("--set", arguments.overrides,
                     "Sets a key of the config, e.g. picture.spp=16, rows[0].domain=disk; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false)
        ->delimiter('\0');
    command->add_flag("--dry-run", arguments.dry_run,
                      "Tells what would be made, and about how long it takes");
    command->add_flag("--denoise", arguments.denoise, "Smooths the noise away, for previews with few paths");
    command->add_flag("--layers", arguments.layers,
                      "Cells' EXR with albedo, normals, depth, position, numbers, variance and samples");
    command->footer(kFigureExamples);
}

void add_morph(CLI::App& app, MorphArguments& arguments) {
    CLI::App* command = app.add_subcommand("morph", "Morphs one mesh into another and writes frames");
    command->add_option("SOURCE", arguments.source, "Mesh at alpha = 0")->type_name("MESH")->required();
    command->add_option("TARGET", arguments.target, "Mesh at alpha = 1")->type_name("MESH")->required();
    command->add_option("--frames", arguments.frames, "How many numbered ones, both ends included")
        ->type_name("N")
        ->check(range(2, 100000))
        ->capture_default_str();
    command
        ->add_option(
            "--out", arguments.out,
            "m.glb: one animated file; m_.ply (.off, .obj, .stl): numbered frames m_000.ply, m_001.ply, ...")
        ->type_name("FILE");
    command
        ->add_option("--correspondence", arguments.correspondence,
                     "CSV: x,y,z on the target per vertex of the source file; nan where mending dropped it")
        ->type_name("FILE");
    command->add_option("--report", arguments.report, "JSON: all that was found, used and measured")
        ->type_name("FILE");
    command->add_option("--seconds", arguments.seconds, "From source to target, in a .glb")
        ->type_name("X")
        ->check(range(0.01, 86400.0))
        ->capture_default_str();
    command->add_flag("--ping-pong", arguments.ping_pong, "And back again, in a .glb");
    add_choice(*command, "--up", arguments.up, kUpAxes, "Which axis of the meshes points up, for a .glb");
    add_morph_options(*command, arguments.options, arguments.interpolation);
    command->add_option("--seed", arguments.options.seed, "Of the registration")
        ->type_name("N")
        ->capture_default_str();
    command->footer(kMorphExamples);

    // An option that would do nothing is a mistake.
    command->parse_complete_callback([command, &arguments] {
        const bool glb = is_glb_file(arguments.out);
        const auto refuse_if_given = [&](const char* flag, const char* why) {
            if (command->get_option(flag)->count() > 0) throw CLI::ValidationError(flag, why);
        };
        if (glb) refuse_if_given("--frames", "for numbered files only; a .glb plays --seconds");
        for (const char* flag : {"--seconds", "--ping-pong", "--up"}) {
            if (!glb) refuse_if_given(flag, "for an animated file only: --out NAME.glb");
        }
    });
}

/// What is wrong with a word that nothing takes. @param command  the innermost one given
std::string about_extra(const CLI::App& app, const CLI::App& command, const std::string& word) {
    std::vector<std::string> known;
    if (word.size() > 1 && word.front() == '-') {
        for (const CLI::App* each : {&command, &app}) {
            for (const CLI::Option* option : each->get_options()) {
                for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
            }
        }
        return fmt::format("there is no option '{}'{}", word, suggestion(word, known));
    }
    for (const CLI::App* each : every_command(command)) known.push_back(each->get_name());
    if (known.empty()) return fmt::format("'{}' is one word too many", word);
    return fmt::format("there is no command '{}'{}; there are {}", word, suggestion(word, known),
                       fmt::join(known, ", "));
}

/// Prints what is wrong with the command line.
int refuse(const CLI::App& app, const CLI::ParseError& error, int count, const char* const* values) {
    std::string path = "automorph";
    const CLI::App* command = &app;
    while (!command->get_subcommands().empty()) {
        command = command->get_subcommands().front();
        path += " " + command->get_name();
    }
    const bool lacks_command = !every_command(*command).empty();
    std::string message = error.what();
    if (lacks_command || dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> left = app.remaining(true);
        const auto extra = std::find_if(values + 1, values + count, [&](const std::string& word) {
            return std::find(left.begin(), left.end(), word) != left.end();
        });
        if (extra != values + count) {
            message = about_extra(app, *command, *extra);
        } else if (lacks_command && dynamic_cast<const CLI::RequiredError*>(&error)) {
            message = "a command is missing";
        }
    }
    // CLI11 counts: "--frames: At Most 1 required but received 2".
    if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && message.find("At Most 1 ") != std::string::npos)
        message = message.substr(0, message.find(':')) + " is given more than once";
    std::replace(message.begin(), message.end(), '\n', ' ');
    fmt::print(stderr, "automorph: {} (see '{} --help')\n", message, path);
    return 1;
}

}  // namespace

void add_morph_options(CLI::App& command, MorphOptions& options, Interpolation& interpolation) {
    add_choice(command, "--alignment", options.alignment, kAlignments, "How the maps are brought together");
    add_choice(command, "--interpolation", interpolation, kInterpolations, "How vertices move");
    add_choice(command, "--openings", options.openings, kOpenings,
               "Openings other than the border (eyes, mouth)");
    add_choice(command, "--domain", options.domain, kDomains,
               "What both are mapped onto: auto is the sphere for closed meshes; for open ones the disk, or "
               "the sphere "
               "where the disk squeezes; cut makes two disks of closed ones");
    command.add_flag_callback(
        "--no-lift", [&options] { options.lift = false; }, "Flat facets instead of curved placement");
}

std::variant<Arguments, int> read_arguments(int count, const char* const* values) {
    CLI::App app(kAbout, "automorph");
    app.set_version_flag("--version", version_text());
    app.footer(kExamples);
    app.require_subcommand(1);
    app.fallthrough();

    Arguments arguments;
    CLI::Option* quiet = app.add_flag("--quiet,-q", arguments.quiet, "Print errors only");
    add_choice(app, "--log-level", arguments.log_level, kLogLevels, "What is told")->excludes(quiet);
    app.add_option("--threads", arguments.threads, "How many threads; results do not depend on it [all]")
        ->type_name("N")
        ->check(range(1, 4096));

    FigureArguments figure;
    MorphArguments morph;
    TurntableArguments turning;
    EllipsoidArguments ellipsoid;
    StarArguments star;
    HeadArguments head;
    InfoArguments info;
    ConfigArguments config;
    DiffArguments diff;
    add_figure(app, figure);
    add_morph(app, morph);
    add_turntable(app, turning);
    add_shape(app, ellipsoid, star, head);
    CLI::App* info_command =
        app.add_subcommand("info", "Tells what a mesh file holds and whether it can be morphed");
    info_command->add_option("MESH", info.meshes, "Mesh files")->type_name("MESH")->required();
    info_command->add_flag("--json", info.json, "As a JSON array, one object per mesh");
    info_command->footer("Its status is 0 if all meshes can be morphed, 1 otherwise.");
    CLI::App* config_command = app.add_subcommand("config", "Explains or checks configs of figures");
    config_command->add_flag("--explain", config.explain, "Print every key with type, default and meaning");
    config_command->add_flag("--schema", config.schema, "Print a JSON Schema of configs, for editors");
    config_command->add_option("CONFIG", config.checked, "YAML files to check; - is standard input")
        ->type_name("YAML");
    config_command->footer(kConfigExamples);

    add_diff(app, diff);
    TextArguments texts;
    add_texts(app, texts);

    try {
        app.parse(count, values);
    } catch (const CLI::ParseError& error) {
        // Help and version arrive here too.
        if (error.get_exit_code() == 0) return app.exit(error);
        const int status = refuse(app, error, count, values);
        return app.got_subcommand("diff") ? static_cast<int>(DiffStatus::CannotCompare) : status;
    }
    if (const std::optional<int> status = print_text(app, texts)) return *status;
    if (arguments.quiet) arguments.log_level = LogLevel::Error;
    arguments.quiet = arguments.log_level < LogLevel::Info;
    CLI::App* shape_command = app.get_subcommand("shape");
    if (app.got_subcommand("figure")) arguments.command = figure;
    if (app.got_subcommand("morph")) arguments.command = morph;
    if (app.got_subcommand("turntable")) arguments.command = turning;
    if (shape_command->got_subcommand("ellipsoid")) arguments.command = ellipsoid;
    if (shape_command->got_subcommand("star")) arguments.command = star;
    if (shape_command->got_subcommand("head")) arguments.command = head;
    if (app.got_subcommand("info")) arguments.command = info;
    if (app.got_subcommand("config")) arguments.command = config;
    if (app.got_subcommand("diff")) arguments.command = diff;
    return arguments;
}

}  // namespace automorph::program
