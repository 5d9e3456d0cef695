#pragma once

#include <string>
#include <vector>

#include "morph/alignment/guide.h"
#include "morph/merge_maps.h"
#include "morph/parameterization/border.h"

namespace automorph {

/// A disk of a shape: the whole of an open one, or one half of a closed one.
struct Disk {
    Mesh mesh;
    std::vector<int> loop;    ///< its border
    std::vector<Site> sites;  ///< per vertex: where it lies on the shape
};

/// Two disks with the same border polygon, not yet mapped.
struct BorderedDisks {
    MappedPart a, b;
    Eigen::VectorXd angles;  ///< #border, radians
};

/// Border insertion, [Urtasun04] Sec. 4.2 and Fig. 3.
BorderedDisks border_disks(const Shape& shape_a, const Disk& a, const Shape& shape_b, const Disk& b,
                           const BorderUnion& border);

/// Below this p01 a disk map squeezes part of a shape to nothing, and both shapes are better off on the
/// sphere.
constexpr double kLeastDiskQuality = 0.1;

struct DiskMapRules {
    const Guide* guide =
        nullptr;  ///< where an alignment puts the vertices of a; none: a has a map of its own
    bool only_good =
        false;          ///< the paper's harmonic maps alone, without flips and with p01 >= kLeastDiskQuality
    std::string label;  ///< " half 1" or "": tells the disks of one morph apart in the report
};

/// Maps both onto the unit disk, [Urtasun04] Sec. 3, and adds the maps to the report. Returns an empty text;
/// with `only_good` possibly why the maps are not good enough: then nothing is reported but the time.
/// @throws SolverFailure  a map flips triangles whatever its weights
std::string map_onto_disk(BorderedDisks& disks, const DiskMapRules& rules, Report& report);

}  // namespace automorph
