#pragma once

#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// Constants of the warp; lengths in the map (radius 1).
struct WarpOptions {
    double reach = 0.5;         ///< d at first: how far a feature drags its neighbours
    double shrink = 0.5;        ///< d is multiplied by this while features are not in place
    double least_reach = 0.01;  ///< a d below this counts as 0: the end
    double tolerance = 1e-4;    ///< a feature nearer to its place is in place, and set there exactly
    int loops = 50;             ///< at most, per d

    bool operator==(const WarpOptions&) const = default;
};

/// A warped map of one mesh.
struct WarpedMap {
    Points rays;                    ///< #V x 3: (x, y, 1); the border as given
    int in_place = 0;               ///< features at their places
    int rounds = 0;                 ///< complete loops over the features
    int shortened = 0;              ///< moves that were shortened because a triangle would have turned
    double reach = 0.0;             ///< the last d
    std::vector<double> distances;  ///< per feature: from its place, at the end
};

/// Moves features of a disk map to their places and drags the vertices around them along: [Alexa00] in the
/// plane, [Urtasun04] Sec. 4.3, second list, steps 3 to 5. The map stays one-to-one.
///
/// Move       t = w - f; every inner h with |h - f| < d moves by t (d - |h - f|). No triangle may turn, by
/// the
///            exact predicate: t is halved until none does, or the move is left out.
/// Rounds     loops over all features until a complete loop brings them hardly nearer; while features are not
///            in place d shrinks.
/// Deviation  the paper's t moves f by a d-th of the way. Here t is longer, t / d, so that f arrives at once,
///            but never so long that the slope of the move, |t|, passes 1/2: with a slope below 1 it is
///            one-to-one in the continuous plane.
/// Ends after at most loops x log(reach / least_reach) rounds, in place or not.
///
/// @param mesh      the disk with all its triangles
/// @param loop      its border: stays, bit for bit
/// @param rays      (x, y, 1), one-to-one on the unit disk
/// @param features  inner vertices, each once
/// @param places    #features x 3: where they shall go, (x, y, 1)
WarpedMap warp_map(const Mesh& mesh, const std::vector<int>& loop, const Points& rays,
                   const std::vector<int>& features, const Points& places, const WarpOptions& options = {});

}  // namespace automorph
