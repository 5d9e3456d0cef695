#include <fmt/format.h>

#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/mesh/write_file.h"
#include "morph/shapes/head.h"
#include "morph/shapes/shapes.h"
#include "render/figure/config.h"
#include "render/figure/figure.h"
#include "render/program/commands.h"

namespace automorph::program {
namespace {

void write_shape(const std::filesystem::path& file, const Mesh& mesh, const Surroundings& surroundings) {
    if (is_mesh_file(file)) make_folder(file.parent_path());
    write_mesh(file, mesh);
    if (surroundings.quiet) return;
    fmt::print("{}: {} vertices, {} triangles\n", file.string(), mesh.vertex_count(), mesh.triangle_count());
}

}  // namespace

void run(const EllipsoidArguments& arguments, const Surroundings& surroundings) {
    const Eigen::Vector3d axes(arguments.semi_axes[0], arguments.semi_axes[1], arguments.semi_axes[2]);
    write_shape(arguments.out, ellipsoid(axes, arguments.options), surroundings);
}

void run(const StarArguments& arguments, const Surroundings& surroundings) {
    if (arguments.parameters.inner > arguments.parameters.outer) {
        throw ConfigError(fmt::format("--inner {}: expected at most --outer, which is {}",
                                      arguments.parameters.inner, arguments.parameters.outer));
    }
    write_shape(arguments.out, star(arguments.parameters, arguments.options), surroundings);
}

void run(const HeadArguments& arguments, const Surroundings& surroundings) {
    HeadOptions options{head_parameters(arguments.preset), arguments.crop, arguments.options};
    for (std::size_t k = 0; k < kHeadParameters.size(); ++k) {
        if (arguments.proportions[k])
            options.parameters.*kHeadParameters[k].member = *arguments.proportions[k];
    }
    write_shape(arguments.out, head(options), surroundings);
}

void run(const ConfigArguments& arguments, const Surroundings& surroundings) {
    if (arguments.schema) fmt::print("{}", config_schema());
    if (arguments.explain || (arguments.checked.empty() && !arguments.schema))
        fmt::print("{}", explain_config());
    for (const std::filesystem::path& file : arguments.checked) {
        const FigureConfig config = load_config(file);
        if (surroundings.quiet) continue;
        const FigureGrid grid = figure_grid(config);
        fmt::print("{}: valid, {} row{} of {} cells\n", config.file.string(), grid.rows,
                   grid.rows == 1 ? "" : "s", grid.columns);
    }
}

}  // namespace automorph::program
