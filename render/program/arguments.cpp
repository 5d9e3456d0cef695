#include "render/program/arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>

#include "render/figure/names.h"
#include "render/program/command_tree.h"
#include "render/program/completion.h"
#include "render/program/help_topics.h"
#include "render/program/man_page.h"
#include "render/program/option_groups.h"
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

constexpr std::array kUpAxes{Named<UpAxis>{"z", UpAxis::Z}, Named<UpAxis>{"y", UpAxis::Y}};

constexpr std::array kLogLevels{
    Named<LogLevel>{"error", LogLevel::Error}, Named<LogLevel>{"warning", LogLevel::Warning},
    Named<LogLevel>{"info", LogLevel::Info}, Named<LogLevel>{"debug", LogLevel::Debug}};

void add_figure(CLI::App& app, FigureArguments& arguments) {
    CLI::App* command = app.add_subcommand("figure", "Makes the figures that YAML configs describe");
    command->add_option("CONFIG", arguments.configs, "YAML files")->type_name("YAML")->required();
    command->add_option("--out", arguments.out, "Folder for the results [the config's output, or out/NAME]")
        ->type_name("DIR");
    command->add_option("--spp", arguments.spp, "Light paths per pixel, instead of the config's")
        ->type_name("N")
        ->check(CLI::Range(1, 65536));
    command->add_option("--scale", arguments.scale, "Scales the cells' width and height")
        ->type_name("X")
        ->check(CLI::Range(0.01, 100.0));
    add_choice(*command, "--quality", arguments.quality, kQualities,
               "draft: half the size, few paths, denoised, no turntable; final: twice the size, four times "
               "the paths");
    command->add_option("--rows", arguments.rows, "Only these rows; the camera stays that of all")
        ->type_name("1,3-4");
    command->add_option("--cells", arguments.cells, "Only these columns")->type_name("1-3");
    command->add_option("--frames", arguments.frames, "Only these frames of the videos")->type_name("A-B");
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
        ->check(CLI::Range(2, 100000))
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
        ->check(CLI::Range(0.01, 86400.0))
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
        ->check(CLI::Range(3, 12))
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

struct TextArguments {
    std::string topic;
    bool man = false;
    std::string shell;
};

using Completion = std::string (*)(const CommandEntry&);

/// Null for a shell that has none.
Completion completion_of(const std::string& shell) {
    if (shell == "bash") return bash_completion;
    if (shell == "fish") return fish_completion;
    if (shell == "zsh") return zsh_completion;
    return nullptr;
}

std::vector<const CLI::App*> every_command(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App*) { return true; });
}

/// To be called last: help names all the other commands.
void add_texts(CLI::App& app, TextArguments& arguments) {
    std::string topics;
    for (const HelpTopic& topic : help_topics()) topics += std::string(topic.name) + "|";
    for (const CLI::App* command : every_command(app)) topics += command->get_name() + "|";
    topics.pop_back();
    CLI::App* help =
        app.add_subcommand("help", "Tells more about a topic or a command, and lists the topics");
    help->add_option("TOPIC", arguments.topic, "Topic or command")->type_name(topics);
    help->add_flag("--man", arguments.man, "Print all as a manual page: automorph help --man | man -l -");

    CLI::App* completion =
        app.add_subcommand("completion", "Prints a script that completes the command line");
    completion->add_option("SHELL", arguments.shell, "Which shell's")
        ->type_name("bash|fish|zsh")
        ->required()
        ->check([](const std::string& shell) {
            return completion_of(shell) ? "" : "found '" + shell + "', allowed are bash|fish|zsh";
        });
    completion->footer(
        "Examples:\n"
        "  source <(automorph completion bash)      for this shell; in ~/.bashrc for all; zsh likewise\n"
        "  automorph completion fish | source       in ~/.config/fish/config.fish for all");
}

int print_help(const CLI::App& app, const TextArguments& arguments) {
    if (arguments.man) {
        fmt::print("{}", man_page(command_tree(app), version()));
        return 0;
    }
    if (arguments.topic.empty()) {
        fmt::print("{}", list_of_topics());
        return 0;
    }
    for (const HelpTopic& topic : help_topics()) {
        if (arguments.topic == topic.name) {
            fmt::print("{}\n\n{}", topic.title, topic.text);
            return 0;
        }
    }
    for (const CLI::App* command : every_command(app)) {
        if (arguments.topic == command->get_name()) {
            fmt::print("{}", command->help("automorph"));
            return 0;
        }
    }
    fmt::print(stderr, "automorph: there is no help on '{}' ('automorph help' lists what there is)\n",
               arguments.topic);
    return 1;
}

int print_completion(const CLI::App& app, const TextArguments& arguments) {
    fmt::print("{}", completion_of(arguments.shell)(command_tree(app)));
    return 0;
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
        ->check(CLI::Range(1, 4096));

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
    config_command->add_option("CONFIG", config.checked, "YAML files to check")->type_name("YAML");

    TextArguments texts;
    add_texts(app, texts);

    add_diff(app, diff);

    try {
        app.parse(count, values);
    } catch (const CLI::ParseError& error) {
        // Help and version arrive here too.
        if (error.get_exit_code() == 0) return app.exit(error);
        const int status = refuse(app, error);
        return app.got_subcommand("diff") ? static_cast<int>(DiffStatus::CannotCompare) : status;
    }
    if (app.got_subcommand("help")) return print_help(app, texts);
    if (app.got_subcommand("completion")) return print_completion(app, texts);
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
