#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "morph/mesh/mesh.h"
#include "morph/registration/registration.h"

namespace automorph {

/// Plane n . x = offset, |n| = 1.
struct Plane {
    Eigen::Vector3d normal;
    double offset;
};

/// One side of a closed mesh cut by a plane.
struct Half {
    Mesh mesh;
    std::vector<int> loop;           ///< the cut: border vertices in boundary direction of this half
    std::vector<int> vertex;         ///< per vertex of the half: vertex of the input, or -1 - k for cut point k
};

/// Both halves; cut points are exact plane-edge crossings, shared by both halves.
struct CutMesh {
    struct CutPoint {
        int from, to;                ///< edge of the input; from below, to above the plane
        double ratio;                ///< v = (1 - ratio) v_from + ratio v_to
    };
    std::array<Half, 2> halves;      ///< [0]: n . x > offset, [1]: below
    std::vector<CutPoint> points;    ///< in the order of halves[0].loop
};

/// True if the plane cuts the closed mesh into exactly two disks.
bool cuts_into_two_disks(const Mesh& mesh, const Plane& plane);

/// Cuts a closed mesh. The plane is moved by less than kPlaneNudge of the mesh's size where it passes through a
/// vertex. halves[1].loop is halves[0].loop the other way round, with the same cut point first.
/// @throws SolverFailure if a side is not one disk
CutMesh cut(const Mesh& mesh, const Plane& plane);

/// The pair of corresponding planes of Sec. 6.
struct CutPlanes {
    Plane source, target;
    int source_vertex = -1, target_vertex = -1;  ///< the match the planes pass through
    double responsibility = 0.0;                 ///< its p_ij
    int matches_tried = 0;                       ///< planes through better matches failed
};

/// [Urtasun04] Sec. 6: plane through the best match (largest p_ij) and the centres of mass. A point and a centre
/// give a line; of the planes through it the one is taken that cuts both meshes into two disks each with a short,
/// balanced cut; else the next best match.
/// @throws SolverFailure if no plane works for any of the matches tried; says how many
CutPlanes choose_cut(const Mesh& source, const Mesh& target, const Registration& registration);

/// The planes of "Section 3 alone": through each centre of mass, the same normal in both files' own axes.
CutPlanes unregistered_cut(const Mesh& source, const Mesh& target);

}  // namespace automorph
