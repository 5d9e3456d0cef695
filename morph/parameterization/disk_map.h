#pragma once

#include <string>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Weights of the convex-combination (or harmonic) map, in the order in which they are tried.
enum class MapWeights { Cotangent, MeanValue, Uniform };

const char* name(MapWeights weights);

/// How good a map is; valid iff `flipped` is 0.
struct MapQuality {
    int flipped = 0;               ///< triangles with det <= 0, by the exact predicate
    double smallest_ratio = 0.0;   ///< smallest (share of the domain) / (share of the surface)
    double p01 = 0.0;              ///< that ratio below which 1 % of the surface lies; 1 is perfect
};

MapQuality map_quality(const Mesh& mesh, const Points& rays);

/// A one-to-one map of a disk onto the unit disk.
struct DiskMap {
    Points rays;                   ///< #V x 3: (x, y, 1); border vertices as given
    MapWeights weights = MapWeights::Cotangent;  ///< those actually used
    std::string reason;            ///< why not cotangent, e.g. "cotangent weights flip 3 triangles"; else empty
    MapQuality quality;
    double residual = 0.0;         ///< relative residual of the solve
};

struct DiskMapOptions {
    MapWeights first = MapWeights::Cotangent;    ///< the weights to start from
};

/// Harmonic map of Sec. 3, Eq. (1)-(2) [Eck95], with the border fixed at `border` (#loop x 3, a strictly convex
/// polygon, counter-clockwise). Where it flips a triangle by the exact predicate, mean value weights
/// [Floater03] are tried, then uniform ones [Tutte63].
/// @throws SolverFailure if every choice flips a triangle; the message gives the counts
DiskMap disk_map(const Mesh& mesh, const std::vector<int>& loop, const Points& border,
                 const DiskMapOptions& options = {});

}  // namespace automorph
