#include <fmt/format.h>

#include "morph/mesh/admit.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"
#include "morph/shapes/head.h"
#include "morph/shapes/shapes.h"
#include "render/figure/config.h"
#include "render/figure/text_file.h"
#include "render/program/commands.h"

namespace automorph::program {
namespace {

void write_shape(const std::filesystem::path& file, const Mesh& mesh, const Surroundings& surroundings) {
    write_mesh(file, mesh);
    if (surroundings.quiet) return;
    fmt::print("{}: {} vertices, {} triangles\n", file.string(), mesh.vertex_count(), mesh.triangle_count());
}

void print_inspection(const MeshInspection& found) {
    fmt::print("  {} vertices, {} polygons, {} triangles, {} component{}\n", found.vertices, found.polygons,
               found.triangles, found.components, found.components == 1 ? "" : "s");
    if (found.closed) {
        fmt::print("  closed\n");
    } else {
        fmt::print("  {} boundary loop{}\n", found.boundary_loops, found.boundary_loops == 1 ? "" : "s");
    }
    const auto defect = [](int count, const char* what) {
        if (count > 0) fmt::print("  {} {}\n", count, what);
    };
    defect(found.non_manifold_edges, "non-manifold edges");
    defect(found.non_manifold_vertices, "non-manifold vertices");
    defect(found.degenerate_triangles, "triangles with a repeated corner");
    defect(found.duplicate_vertices, "duplicate vertices");
    defect(found.unused_vertices, "unused vertices");
    defect(found.inconsistent_edges, "edges between triangles of opposite orientation");
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

void run(const InfoArguments& arguments, const Surroundings&) {
    for (const std::filesystem::path& file : arguments.meshes) {
        const PolygonSoup soup = read_mesh(file);
        fmt::print("{}\n", file.string());
        print_inspection(inspect(soup));
        try {
            const AdmittedMesh admitted = admit(soup, file.string());
            for (const std::string& mended : admitted.mended) fmt::print("  would be mended: {}\n", mended);
            fmt::print("  can be morphed: {} vertices, {} triangles, {}\n", admitted.mesh.vertex_count(),
                       admitted.mesh.triangle_count(), admitted.admitted.closed ? "closed" : "open");
        } catch (const InvalidMesh& error) {
            fmt::print("  cannot be morphed: {}\n", error.what());
        }
    }
}

void run(const ConfigArguments& arguments, const Surroundings& surroundings) {
    if (arguments.schema) fmt::print("{}", config_schema());
    if (arguments.explain || (arguments.checked.empty() && !arguments.schema))
        fmt::print("{}", explain_config());
    for (const std::filesystem::path& file : arguments.checked) {
        const FigureConfig config = load_config(file);
        if (surroundings.quiet) continue;
        fmt::print("{}: valid, {} row{} of {} cells\n", file.string(), config.rows.size(),
                   config.rows.size() == 1 ? "" : "s", config.alphas.size());
    }
}

}  // namespace automorph::program
