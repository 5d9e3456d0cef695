#pragma once

#include "morph/mesh/mesh.h"

namespace automorph {

/// How much a map distorts, a factor >= 1 per triangle; 1 is none. Shares are of the surface's area, so that
/// how finely a place is tessellated does not matter.
struct Distortion {
    double median = 1.0;
    double p95 = 1.0;    ///< 95 % of the surface is distorted less
    double worst = 1.0;  ///< infinite where a triangle collapses in double precision
};

/// How good a map is; valid iff `flipped` is 0.
struct MapQuality {
    int flipped = 0;              ///< triangles with det <= 0, by the exact predicate
    double smallest_ratio = 0.0;  ///< smallest (share of the domain) / (share of the surface), both areas
    double p01 = 0.0;             ///< that ratio below which 1 % of the surface lies; 1 is perfect
    Distortion area;  ///< share of the domain over share of the surface, or its inverse, whichever is above 1
    Distortion angle;  ///< larger over smaller singular value of the map of a triangle: 1 is conformal
};

/// Measures a map onto the disk. Triangles without area in 3D have no ratio and count for `flipped` only.
/// @param rays  #V x 3, (x, y, 1)
MapQuality map_quality(const Mesh& mesh, const Points& rays);

/// Measures a map onto the sphere, or a part of it: areas of the domain are solid angles.
/// @param rays  #V x 3, of any length
MapQuality sphere_map_quality(const Mesh& mesh, const Points& rays);

/// Sum of the signed solid angles of triangles, each in (-2 pi, 2 pi]: 4 pi for each time the sphere is
/// covered.
double total_solid_angle(const Triangles& F, const Points& rays);

/// How many times a closed mesh without flipped triangles covers the sphere, by the exact predicate: only
/// once is one-to-one. Positive triangles alone may go twice around a vertex. 0: the rays are no numbers.
int covering_degree(const Triangles& F, const Points& rays);

/// Triangles with det <= 0, by the exact predicate; for any rays.
int flipped_triangles(const Triangles& F, const Points& rays);

}  // namespace automorph
