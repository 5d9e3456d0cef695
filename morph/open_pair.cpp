#include "morph/open_pair.h"

#include <algorithm>

#include "morph/mesh/connectivity.h"
#include "morph/overlay/lift.h"
#include "morph/parameterization/border_control.h"
#include "morph/parameterization/fill.h"

namespace automorph {

namespace {

FilledShape border_left_open(const Mesh& mesh, std::vector<std::vector<int>> loops) {
    FilledShape filled = filled_shape(mesh, {loops.begin() + 1, loops.end()});
    filled.loops = std::move(loops);
    filled.centres.insert(filled.centres.begin(), -1);
    return filled;
}

}  // namespace

FilledShape filled_shape(const Mesh& mesh, const std::vector<std::vector<int>>& openings) {
    FilledShape result{{mesh, smooth_normals(mesh), mesh.vertex_count()}, openings, {}};
    if (openings.empty()) return result;
    FilledMesh filled = fill_openings(mesh, openings);
    result.shape.mesh = std::move(filled.mesh);
    result.centres = std::move(filled.centres);
    result.shape.normals.conservativeResizeLike(Points::Zero(result.shape.mesh.vertex_count(), 3));
    return result;
}

OpenPair open_pair(const Mesh& source, const Mesh& target, const Registration* registration) {
    std::vector<std::vector<int>> source_loops = boundary_loops(source),
                                  target_loops = boundary_loops(target);
    OpenPair pair;
    pair.target_mesh = target;
    BorderControl control;
    if (registration)
        control = registered_control(source, source_loops[0], target, target_loops[0], *registration);
    if (control.target_reversed) {
        ReversedTarget reversed = reversed_target(target, target_loops[0], control);
        pair.target_mesh = std::move(reversed.mesh);
        control = reversed.control;
        target_loops[0] = std::move(reversed.loop);
        // Not asked for anew: of two that are equally long either may come first.
        for (std::size_t k = 1; k < target_loops.size(); ++k)
            std::reverse(target_loops[k].begin() + 1, target_loops[k].end());
        pair.target_reversed = true;
    }
    pair.border = border_union(loop_points(source, source_loops[0]),
                               loop_points(pair.target_mesh, target_loops[0]), control);
    pair.source = border_left_open(source, std::move(source_loops));
    pair.target = border_left_open(pair.target_mesh, std::move(target_loops));
    return pair;
}

}  // namespace automorph
