#pragma once

#include <string>
#include <vector>

#include "morph/mesh/mesh.h"

namespace automorph {

/// A shape, or a part of it, on the disk or the sphere.
struct DomainMap {
    Mesh mesh;                     ///< openings other than the border are filled
    std::vector<char> is_filling;  ///< per triangle: it fills an opening
    std::vector<int> loop;         ///< its border; empty of a closed shape
    Points rays;                   ///< #V x 3: (x, y, 1) on the unit disk, or unit vectors on the sphere

    bool on_disk() const {
        constexpr double kRounding = 1e-9;
        return !loop.empty() && (rays.col(2).array() - 1.0).abs().maxCoeff() < kRounding;
    }
};

/// Two maps of the same domain as they were overlaid: what lies on one spot of it is one point of the morph.
struct DomainMaps {
    DomainMap source, target;  ///< borders have each other's vertices
    std::string part;          ///< "half 1", "half 2" of shapes that were cut; else empty
};

}  // namespace automorph
