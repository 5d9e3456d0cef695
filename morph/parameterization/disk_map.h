#pragma once

#include <string>
#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/parameterization/map_quality.h"
#include "morph/parameterization/map_weights.h"

namespace automorph {

/// A one-to-one map of a disk onto the unit disk.
struct DiskMap {
    Points rays;                                 ///< #V x 3: (x, y, 1); border vertices as given
    MapWeights weights = MapWeights::Cotangent;  ///< those actually used
    std::string reason;  ///< why not the first choice, e.g. "cotangent weights flip 3 triangles"; else empty
    MapQuality quality;
    double residual = 0.0;  ///< |sum_j w_ij (h_j - h_i)| relative to that of the border alone
    int guarded = 0;        ///< triangles whose weights were bounded (no area); see weight_matrix
    int repaired = 0;       ///< vertices moved one by one because the solve alone flipped triangles
};

struct DiskMapOptions {
    MapWeights first = MapWeights::Cotangent;  ///< the weights to start from
    bool fallbacks =
        true;  ///< other weights and repair where the first flip a triangle; otherwise SolverFailure
};

/// Harmonic map of Sec. 3, Eq. (1)-(2) [Eck95], with the border fixed at `border` (#loop x 3, a strictly
/// convex polygon, counter-clockwise).
///
/// Method     one sparse factorisation (LDLT; LU for mean value weights), two right-hand sides, two steps of
///            iterative refinement with residuals formed from differences h_j - h_i.
/// Deviation  where the map flips a triangle by the exact predicate, mean value weights [Floater03] follow:
///            positive weights and a strictly convex border make a one-to-one map. Where rounding flips some
///            all the same (triangles below 1e-15), they are turned vertex by vertex (repair_map), so that
///            rounding does not choose the map. Last come uniform weights [Tutte63].
/// @pre one component, one boundary loop, Euler characteristic 1, every vertex used
/// @throws InvalidMesh   the precondition is broken; the message gives the counts found
/// @throws SolverFailure every choice flips a triangle; the message gives the counts
DiskMap disk_map(const Mesh& mesh, const std::vector<int>& loop, const Points& border,
                 const DiskMapOptions& options = {});

}  // namespace automorph
