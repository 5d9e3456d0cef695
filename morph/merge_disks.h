#pragma once

#include <string>
#include <vector>

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
BorderedDisks border_disks(const Disk& a, const Disk& b, const BorderUnion& border);

/// Below this p01 a disk map squeezes part of a shape to nothing, and both shapes go onto the sphere.
constexpr double kLeastDiskQuality = 0.1;

/// Maps both onto the unit disk, [Urtasun04] Sec. 3, and adds the maps to the report.
/// @throws SolverFailure  a map flips triangles whatever its weights
void map_onto_disk(BorderedDisks& disks, const std::string& label, Report& report);

/// The same with the paper's harmonic map alone: empty if it did, else why it is not good enough for one of
/// the shapes (a flip, or p01 below kLeastDiskQuality); nothing is reported then.
std::string try_harmonic_disk(BorderedDisks& disks, Report& report);

}  // namespace automorph
