#include <algorithm>

#include "render/program/option_groups.h"

namespace automorph::program {
namespace {

constexpr const char* kShapeExamples = R"(Examples:
  automorph shape ellipsoid egg.ply --semi-axes 1 0.8 0.6
  automorph shape star meshes/star.off --arms 6
  automorph shape head face.ply --preset asian --crop face --triangles 20000 --nose-length 1.1)";

void add_shape_options(CLI::App& command, std::filesystem::path& out, ShapeOptions& options) {
    command.add_option("--out,OUT", out, ".ply, .obj, .off or .stl; folders that are missing are made")
        ->type_name("FILE")
        ->required();
    command.footer(kShapeExamples);
    command.add_option("--triangles", options.triangles, "How many, about")
        ->check(range(64, 10'000'000))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Another seed gives another tessellation")
        ->capture_default_str();
    command.add_option("--scale", options.scale, "Size")->check(range(1e-9, 1e12))->capture_default_str();
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
            ->check(range(each.least, each.most))
            ->group("Proportions");
    }
}

}  // namespace

void add_shape(CLI::App& app, EllipsoidArguments& round, StarArguments& star, HeadArguments& head) {
    CLI::App* command = app.add_subcommand("shape", "Generates a shape");
    command->require_subcommand(1);
    command->footer(kShapeExamples);
    const CLI::Validator positive = range(1e-9, 1e12);

    CLI::App* ellipsoid = command->add_subcommand("ellipsoid", "An ellipsoid");
    add_shape_options(*ellipsoid, round.out, round.options);
    ellipsoid->add_option("--semi-axes", round.semi_axes, "Half extents in x, y, z")
        ->expected(3)
        ->check(positive)
        ->capture_default_str();

    CLI::App* arms = command->add_subcommand("star", "A smooth solid star in the xy-plane");
    add_shape_options(*arms, star.out, star.options);
    arms->add_option("--arms", star.parameters.arms, "How many")->check(range(3, 12))->capture_default_str();
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

}  // namespace automorph::program
