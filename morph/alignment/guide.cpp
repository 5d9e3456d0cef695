#include "morph/alignment/guide.h"

#include <algorithm>
#include <optional>

#include "morph/alignment/border_places.h"
#include "morph/alignment/border_pull.h"
#include "morph/mesh/geometry.h"

namespace automorph {

namespace {

/// Openings that correspond: rim on rim, centre on centre.
void pin_openings(const AlignedShape& source, const AlignedShape& target, Guide& guide) {
    for (const LoopPair pair : paired_loops(guide.x, source.loops, target.mesh.V, target.loops)) {
        if (pair.source == 0) continue;  // the border, see aligned_border
        const std::vector<int>& rim = source.loops[static_cast<std::size_t>(pair.source)];
        const std::vector<int>& partner = target.loops[static_cast<std::size_t>(pair.target)];
        const Points partner_points = target.mesh.V(partner, Eigen::all);
        const std::optional<Eigen::VectorXd> angles =
            monotone_angles(guide.x(rim, Eigen::all), partner_points);
        if (!angles) continue;
        const Eigen::VectorXd partner_angles = arc_length_angles(partner_points, 0);
        for (std::size_t k = 0; k < rim.size(); ++k) {
            guide.pinned.emplace_back(
                rim[k], place_on_loop(partner, partner_angles, (*angles)[static_cast<Eigen::Index>(k)]));
        }
        const int centre = target.centres[static_cast<std::size_t>(pair.target)];
        guide.pinned.emplace_back(source.centres[static_cast<std::size_t>(pair.source)],
                                  SurfacePlace{{centre, centre, centre}, {1.0, 0.0, 0.0}});
    }
}

}  // namespace

Guide align(const AlignedShape& source, const Points& start, const AlignedShape& target,
            const NonRigidOptions& options) {
    const NonRigidAlignment alignment =
        align_nonrigid(source.mesh, source.loops, start, target.mesh, target.loops, options);
    const auto own = alignment.x.rows(),
               all = own + std::count_if(source.centres.begin(), source.centres.end(),
                                         [](int centre) { return centre >= 0; });
    Guide guide;
    guide.distance = alignment.distance;
    guide.source_limbs = alignment.source_limbs;
    guide.target_limbs = alignment.target_limbs;
    guide.matched_tips = alignment.matched_tips;
    guide.x = alignment.x;
    guide.x.conservativeResize(all, 3);
    guide.normals = Points::Zero(all, 3);
    guide.normals.topRows(own) = vertex_normals({alignment.x, source.mesh.F});
    for (std::size_t k = 0; k < source.centres.size(); ++k) {
        if (source.centres[k] >= 0)
            guide.x.row(source.centres[k]) = alignment.x(source.loops[k], Eigen::all).colwise().mean();
    }
    pin_openings(source, target, guide);
    return guide;
}

}  // namespace automorph
