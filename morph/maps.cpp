#include "morph/maps.h"

#include <fmt/format.h>

#include <algorithm>

#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/open_pair.h"
#include "morph/parameterization/disk_map.h"
#include "morph/parameterization/sphere_map.h"
#include "morph/registration/registration.h"
#include "morph/report_of.h"

namespace automorph {

namespace {

ShapeMap map_onto_sphere(const InputMesh& shape) {
    const SphereMap map = sphere_map(shape.mesh);
    const auto triangles = static_cast<std::size_t>(shape.mesh.triangle_count());
    return {{shape.mesh, std::vector<char>(triangles, 0), {}, map.rays},
            report_of(shape.report.name, "progressive embedding", map.quality)};
}

ShapeMap map_onto_disk(const InputMesh& shape) {
    const std::vector<std::vector<int>> loops = boundary_loops(shape.mesh);
    FilledShape filled = filled_shape(shape.mesh, {loops.begin() + 1, loops.end()});
    const Eigen::VectorXd angles = arc_length_angles(loop_points(shape.mesh, loops[0]), 0);
    const DiskMap map = disk_map(filled.shape.mesh, loops[0], border_rays(angles));
    std::vector<char> is_filling(static_cast<std::size_t>(filled.shape.mesh.triangle_count()), 1);
    std::fill_n(is_filling.begin(), shape.mesh.triangle_count(), 0);
    return {{std::move(filled.shape.mesh), std::move(is_filling), loops[0], map.rays},
            report_of(shape.report.name, map)};
}

}  // namespace

ShapeMap map_shape(const InputMesh& shape) {
    return shape.report.closed ? map_onto_sphere(shape) : map_onto_disk(shape);
}

BorderInsertion insert_borders(const InputMesh& source, const InputMesh& target, std::uint64_t seed) {
    for (const InputMesh* shape : {&source, &target}) {
        if (shape->report.closed)
            throw InvalidMesh(
                fmt::format("{} is closed: it has no border to insert into", shape->report.name));
    }
    const Registration registration = register_rigid(source.mesh, target.mesh, {.seed = seed});
    OpenPair pair = open_pair(source.mesh, target.mesh, &registration);
    return {loop_points(source.mesh, pair.source.loops[0]),
            loop_points(pair.target_mesh, pair.target.loops[0]), std::move(pair.border),
            report_of(registration, true)};
}

}  // namespace automorph
