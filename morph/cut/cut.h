#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "morph/mesh/connectivity.h"
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
    std::vector<int> loop;    ///< the cut: border vertices in boundary direction of this half
    std::vector<int> vertex;  ///< per vertex of the half: vertex of the input, or -1 - k for cut point k
};

/// Both halves; cut points are plane-edge crossings, shared by both halves.
struct CutMesh {
    struct CutPoint {
        int from, to;  ///< edge of the input; from below, to above the plane
        double ratio;  ///< v = (1 - ratio) v_from + ratio v_to
    };
    std::array<Half, 2> halves;    ///< [0]: n . x > offset, [1]: below
    std::vector<CutPoint> points;  ///< in the order of halves[0].loop
};

/// The plane is moved along its normal by at most this share of the mesh's bounding box diagonal, so that it
/// keeps clear of vertices: every cut point lies inside an edge.
constexpr double kPlaneNudge = 1e-4;

/// What a plane does to a closed mesh of genus 0.
struct Section {
    int loops = 0;                              ///< closed curves of the cut; 1 means two disks
    double length = 0.0;                        ///< of the cut, scene units
    double area_above = 0.0, area_below = 0.0;  ///< of the two sides, squared scene units
};
Section section(const Mesh& mesh, const Connectivity& topology, const Plane& plane);

/// Cuts a closed mesh of genus 0 in two. halves[1].loop is halves[0].loop the other way round, with the same
/// cut point first; both halves hold bit-identical positions there.
/// @throws SolverFailure if a side is not one disk; says how many closed curves the cut has
CutMesh cut(const Mesh& mesh, const Plane& plane);

/// The pair of corresponding planes of Sec. 6.
struct CutPlanes {
    Plane source, target;
    int source_vertex = -1, target_vertex = -1;  ///< the match the planes pass through
    double responsibility = 0.0;                 ///< its p_ij
    int matches_tried = 0;                       ///< matches used up, this one included
};

/// [Urtasun04] Sec. 6: plane through the best match (largest p_ij) and the centre of mass, in the target the
/// same plane under R, tilted to pass through the target's own match and centre. A point and a centre give a
/// line only.
///
/// Beyond the paper: of kPencil planes through that line the one is taken whose halves suit a disk best: all
/// four are disks, and the worst of them has the longest border for its area (a short border squeezes the
/// map; balance follows, as the larger half is the worse one). If none cuts both shapes into disks, the next
/// best match that is not a neighbour of a failed one.
/// @throws SolverFailure if no plane works for any match; says how many were tried
CutPlanes choose_cut(const Mesh& source, const Mesh& target, const Registration& registration);

/// The planes of "Section 3 alone": through each centre of mass, with the first of the files' axes z, y, x as
/// normal that cuts both shapes into disks, else the first of kPencil directions between them.
/// @throws SolverFailure if none does
CutPlanes unregistered_cut(const Mesh& source, const Mesh& target);

}  // namespace automorph
