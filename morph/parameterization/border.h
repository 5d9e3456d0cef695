#pragma once

#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/parameterization/border_control.h"
#include "morph/parameterization/border_union.h"

namespace automorph {

/// A mesh's border with the vertices of the other mesh's border inserted.
struct BorderedMesh {
    Mesh mesh;              ///< input vertices keep their indices; inserted ones follow. Input triangles keep
                            ///< theirs (a split one is its first part); the other parts follow
    std::vector<int> loop;  ///< border vertices in order, counter-clockwise in the map; [k] at angle k
    struct Inserted {
        int from, to;  ///< the border edge of the input it lies on
        double ratio;  ///< v = (1 - ratio) v_from + ratio v_to
    };
    std::vector<Inserted> inserted;  ///< vertex (input count + k) is inserted[k]
    std::vector<int> parent;         ///< triangle (input count + k) is a part of input triangle parent[k]
};

/// Inserts the union's vertices on the border edges of a mesh; the surface stays the same. A border triangle
/// is split into a strip: a fan from the opposite vertex where one of its edges is on the border, a zigzag of
/// short edges where two are (an ear), so that no part has three corners on one line.
/// @param sites  one side of a BorderUnion: its places on `loop`, in order
/// @throws InvalidMesh  `loop` is not a boundary loop of the mesh in the direction of its triangles
BorderedMesh insert_border(const Mesh& mesh, const std::vector<int>& loop,
                           const std::vector<BorderSite>& sites);

/// Two borders with the same polygon: loop vertices of equal position correspond and share their angle.
/// [Urtasun04] Sec. 4.2 and Fig. 3.
struct CommonBorder {
    BorderedMesh source, target;
    Eigen::VectorXd angles;  ///< #border, radians in [0, 2 pi), strictly increasing, angles[0] = 0
    int shared = 0;          ///< border vertices of both meshes that coincided within the snap tolerance
};

/// Gives both borders the union of their arc-length angles (Fig. 3): a vertex is inserted on the other
/// border's edge unless one is there already (within kBorderSnap). Neighbouring angles stay far enough apart
/// for the polygon to be strictly convex in doubles. border_union and insert_border in one call.
/// @pre control.target_reversed is false: the caller goes through reversed_target first
/// @throws InvalidMesh  a loop is not a boundary loop of its mesh
CommonBorder common_border(const Mesh& source, const std::vector<int>& source_loop, const Mesh& target,
                           const std::vector<int>& target_loop, const BorderControl& control);

}  // namespace automorph
