#include "morph/parameterization/fill.h"

#include <fmt/format.h>

#include <numeric>

#include "morph/mesh/errors.h"

namespace automorph {

FilledMesh fill_openings(const Mesh& mesh, const std::vector<std::vector<int>>& loops) {
    const auto added = std::accumulate(loops.begin(), loops.end(), std::size_t{0},
                                       [](std::size_t sum, const auto& loop) { return sum + loop.size(); });
    FilledMesh filled;
    filled.mesh.V.resize(mesh.vertex_count() + static_cast<Eigen::Index>(loops.size()), 3);
    filled.mesh.V.topRows(mesh.vertex_count()) = mesh.V;
    filled.mesh.F.resize(mesh.triangle_count() + static_cast<Eigen::Index>(added), 3);
    filled.mesh.F.topRows(mesh.triangle_count()) = mesh.F;
    filled.is_filling.assign(static_cast<std::size_t>(mesh.triangle_count()), 0);
    filled.is_filling.resize(static_cast<std::size_t>(mesh.triangle_count()) + added, 1);

    int centre = mesh.vertex_count(), f = mesh.triangle_count();
    for (const std::vector<int>& loop : loops) {
        if (loop.size() < 3) {
            throw InvalidMesh(
                fmt::format("an opening of {} vertices cannot be filled: 3 are needed", loop.size()));
        }
        Eigen::RowVector3d mean = Eigen::RowVector3d::Zero();
        for (std::size_t k = 0; k < loop.size(); ++k) {
            if (loop[k] < 0 || loop[k] >= mesh.vertex_count()) {
                throw InvalidMesh(fmt::format("an opening names vertex {}, the mesh has vertices 0 to {}",
                                              loop[k], mesh.vertex_count() - 1));
            }
            mean += mesh.V.row(loop[k]) / static_cast<double>(loop.size());
            // The neighbour runs from loop[k] to the next; the fan's triangle the other way.
            filled.mesh.F.row(f++) << loop[(k + 1) % loop.size()], loop[k], centre;
        }
        filled.mesh.V.row(centre) = mean;
        filled.centres.push_back(centre++);
    }
    return filled;
}

}  // namespace automorph
