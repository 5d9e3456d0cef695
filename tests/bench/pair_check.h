#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/morph.h"

namespace automorph::bench {

/// A morph held against its two inputs.
struct PairCheck {
    std::string route;                   ///< "disk", "sphere", "locked", "capped"
    int triangles = 0;                   ///< merged
    int flipped = 0;                     ///< triangles of both maps, exact
    int turned = 0;                      ///< merged triangles that face against the shape, both ends
    int missing = 0;                     ///< vertices of either input that its frame lacks, bit for bit
    double off_first = 0, off_last = 0;  ///< Hausdorff distance of the frames at 0 and 1 from the inputs, %
                                         ///< of the input's diagonal
    bool dense = false, confident = false;
    double p01 = 0;                       ///< the smaller of both maps
    double seconds = 0, cpu_seconds = 0;  ///< of the morph, without the check
    std::vector<StageReport> stages;
};

/// Morphs and checks. Where openings of the other shape were opened in this one too, vertices and surface
/// that went with them are not missed.
PairCheck check_pair(const InputMesh& source, const InputMesh& target, const MorphOptions& options);

/// A mesh turned at random and scaled by 1/10 to 10.
Mesh posed_at_random(Mesh mesh, std::uint64_t seed);

}  // namespace automorph::bench
