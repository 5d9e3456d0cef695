#include "render/program/option_groups.h"
#include "render/program/timeline_names.h"

namespace automorph::program {
namespace {

constexpr const char* kTurntableExamples = R"(Examples:
  automorph turntable head.ply --out turn/head_.png
      turn/head_000.png ... head_095.png: one revolution that can be played over and over
  automorph turntable scan.stl --up z --out scan.mp4
      of a file with z upwards; frames go to scan_frames/, ffmpeg makes the video
  automorph turntable a.ply b.ply --revolutions 2 --hold 0.1 --out ab.mp4
      a becomes b and a again, while both turn twice, with a rest at each end
  automorph turntable a.ply b.ply --loop once --revolutions 0 --easing linear --out m_.exr
      the morph alone, from the front
  automorph turntable a.ply b.ply --alpha 0.5 --out half_.png
      the shape half way turns
  automorph turntable head.ply --width 1920 --height 1080 --spp 256 --frame-range 0-47 --out big_.png
      a part of the sequence; another machine may make 48-95
  automorph turntable a.ply b.ply --shutter 0.5 --spp 128 --out soft.mp4
      with motion blur, which takes more light paths to be smooth
  automorph turntable head.ply --frames 4 --spp 8 --out try_.png
      a quick look: four sides
Stopped, killed, or with a full disk: the same command again goes on. Each frame tells in its file what it was made of; frames whose meshes, options, seed and version are the same are kept.)";

void add_motion(CLI::App& command, turntable::TimelineOptions& timeline) {
    command.add_option("--frames", timeline.frames, "How many in the whole sequence")
        ->type_name("N")
        ->check(range(1, 100000))
        ->capture_default_str();
    command
        .add_option("--revolutions", timeline.revolutions,
                    "How often it turns, counter-clockwise seen from above; negative: clockwise, 0: not, "
                    "fractions: a part")
        ->type_name("R")
        ->check(range(-1e6, 1e6))
        ->capture_default_str();
    command.add_option("--start", timeline.start, "Turned by so much before the first frame")
        ->type_name("DEG")
        ->check(range(-1e6, 1e6))
        ->capture_default_str();
    command
        .add_option("--shutter", timeline.shutter,
                    "Motion blur: share of the time between two frames during which the shutter is open, "
                    "around the frame's moment; 0: none, 0.5: as film cameras do")
        ->type_name("S")
        ->check(range(0.0, 1.0))
        ->capture_default_str();
    add_choice(command, "--turn-easing", timeline.turn_easing, kEasings,
               "How it turns: evenly, or from rest to rest");
    CLI::Option* easing = add_choice(command, "--easing", timeline.morph_easing, kEasings,
                                     "How it morphs: evenly, or from rest to rest");
    CLI::Option* loop =
        add_choice(command, "--loop", timeline.loop, kLoops, "The morph goes there and back, or there");
    CLI::Option* hold =
        command
            .add_option("--hold", timeline.hold, "Share of the sequence in which the morph rests at each end")
            ->type_name("X")
            ->check(range(0.0, 0.49))
            ->capture_default_str();
    command
        .add_option_function<double>(
            "--alpha", [&timeline](const double& alpha) { timeline.alpha = alpha; },
            "Turns this in-between of the morph, 0 the source and 1 the target, and does not morph")
        ->type_name("A")
        ->check(range(0.0, 1.0))
        ->excludes(hold)
        ->excludes(loop)
        ->excludes(easing);
}

void add_picture(CLI::App& command, TurntableArguments& arguments) {
    command.add_option("--up", arguments.up, "What is up in the files: x, y, z, -x, -y, -z or X,Y,Z")
        ->type_name("AXIS")
        ->capture_default_str();
    command
        .add_option("--view", arguments.view,
                    "Where the camera looks at the start, likewise [-z, or y with --up z]")
        ->type_name("AXIS");
    command.add_option("--elevation", arguments.elevation, "Degrees the camera looks downwards")
        ->type_name("DEG")
        ->check(range(0.0, 89.0))
        ->capture_default_str();
    command.add_option("--fov", arguments.fov, "Vertical field of view, degrees")
        ->type_name("DEG")
        ->check(range(1.0, 120.0))
        ->capture_default_str();
    command.add_option("--margin", arguments.margin, "Free on each side, as a share of half the picture")
        ->type_name("X")
        ->check(range(0.0, 0.9))
        ->capture_default_str();
    command.add_flag("--flat", arguments.flat, "Shows the facets instead of smooth normals");
    for (const auto& [flag, value] :
         {std::pair{"--width", &arguments.width}, std::pair{"--height", &arguments.height}}) {
        command.add_option(flag, *value, "Of the pictures, pixels")
            ->type_name("N")
            ->check(range(1, 16384))
            ->capture_default_str();
    }
    command.add_option("--spp", arguments.spp, "Light paths per pixel")
        ->type_name("N")
        ->check(range(1, 65536))
        ->capture_default_str();
}

}  // namespace

void add_turntable(CLI::App& app, TurntableArguments& arguments) {
    CLI::App* command =
        app.add_subcommand("turntable", "Turns a mesh, or a morph of two, and pictures it frame by frame");
    command->add_option("MESH", arguments.source, "What turns")->type_name("MESH")->required();
    CLI::Option* target =
        command->add_option("TARGET", arguments.target, "What it becomes meanwhile")->type_name("MESH");
    command
        ->add_option("--out", arguments.out,
                     "turn_.png or turn_.exr: numbered frames turn_000.png, ...; turn.mp4 or turn.webm: a "
                     "video, and its frames in turn_frames/")
        ->type_name("FILE")
        ->capture_default_str();
    add_motion(*command, arguments.timeline);
    add_picture(*command, arguments);
    command->add_option("--seed", arguments.seed, "Of the noise and of the registration")
        ->type_name("N")
        ->capture_default_str();
    command
        ->add_option("--frame-range", arguments.frame_range,
                     "Makes only these, e.g. 0-47, 48- or 7; counted from 0")
        ->type_name("A-B");
    command->add_option("--fps", arguments.fps, "Frames per second of a video")
        ->type_name("X")
        ->check(range(0.1, 1000.0))
        ->capture_default_str();
    command->add_flag("--redo", arguments.redo, "Makes finished frames anew, too");
    add_morph_options(*command, arguments.morph, arguments.interpolation);
    for (const char* flag : {"--easing", "--loop", "--hold", "--alpha", "--alignment", "--interpolation",
                             "--openings", "--domain", "--no-lift"})
        command->get_option(flag)->needs(target)->group("Morph, with a TARGET");
    command->footer(kTurntableExamples);
}

}  // namespace automorph::program
