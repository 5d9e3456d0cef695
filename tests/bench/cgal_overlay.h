#pragma once

#include <memory>

#include "morph/mesh/mesh.h"

namespace automorph::bench {

/// The overlay of two planar maps by CGAL's Arrangement_2 with exact constructions: the yardstick. GPL, so it
/// stays in the benchmark.
class CgalOverlay {
public:
    struct Counts {
        int vertices, faces;  ///< faces without the unbounded one
    };

    /// Builds the arrangement of each map's edges. @pre rays with z = 1
    CgalOverlay(const Mesh& a, const Points& rays_a, const Mesh& b, const Points& rays_b);
    ~CgalOverlay();

    /// Overlays the two arrangements.
    Counts run() const;

private:
    struct Arrangements;
    std::unique_ptr<Arrangements> arrangements_;
};

}  // namespace automorph::bench
