#pragma once

#include <Eigen/Core>
#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/registration/registration.h"

namespace automorph {

/// Where the two borders are tied together: position `source` in the source loop and `target` in the target
/// loop get angle 0. [Urtasun04] Sec. 4.2 "boundary control vertices".
struct BorderControl {
    int source = 0;              ///< index into the source loop (not a vertex)
    int target = 0;              ///< index into the target loop
    bool target_reversed = false;///< the target's loop has to be run the other way round, Eq. (8)
    double responsibility = 0.0; ///< p_ij of the pair; 0 when chosen without registration
    double convolution = 0.0;    ///< C of Eq. (8) of the direction chosen
    double convolution_reversed = 0.0;  ///< C of the other direction
};

/// The border pair with the largest p_ij, and the direction with the larger C.
BorderControl registered_control(const Mesh& source, const std::vector<int>& source_loop, const Mesh& target,
                                 const std::vector<int>& target_loop, const Registration& registration);

/// A mesh's border on the unit circle.
struct BorderedMesh {
    Mesh mesh;                   ///< input vertices keep their indices; inserted ones follow
    std::vector<int> loop;       ///< border vertices in order, counter-clockwise in the map
    struct Inserted {
        int from, to;            ///< the border edge of the input it lies on
        double ratio;            ///< v = (1 - ratio) v_from + ratio v_to
    };
    std::vector<Inserted> inserted;  ///< vertex (input count + k) is inserted[k]
};

/// Two borders with the same polygon: loop vertices of equal position correspond and share their angle.
/// [Urtasun04] Sec. 4.2 and Fig. 3.
struct CommonBorder {
    BorderedMesh source, target;
    Eigen::VectorXd angles;      ///< #border, radians in [0, 2 pi), strictly increasing, angles[0] = 0
    int shared = 0;              ///< border vertices of both meshes that coincided within the snap tolerance
};

/// Gives both borders the union of their arc-length angles (Fig. 3): a vertex is inserted on the other border's
/// edge unless one is there already (within kBorderSnap). Neighbouring angles stay far enough apart for the
/// polygon to be strictly convex in doubles.
/// @pre control.target_reversed is false: the caller reverses the target's triangles (and loop) first
CommonBorder common_border(const Mesh& source, const std::vector<int>& source_loop, const Mesh& target,
                           const std::vector<int>& target_loop, const BorderControl& control);

/// Rays (cos, sin, 1) of the angles, #border x 3: identical doubles for both maps.
Points border_rays(const Eigen::VectorXd& angles);

}  // namespace automorph
