#pragma once

#include "morph/alignment/guide.h"
#include "morph/merge_maps.h"
#include "morph/sphere_alignment/surface_matches.h"

namespace automorph {

/// Gives part a, mapped onto the disk, the map that puts its vertices where a dense alignment says they
/// belong on b, made one-to-one (guided_map); the loop keeps its rays. Says in the report what it took.
/// @param a  a whole shape, mapped; keeps its map where the guided one cannot be made one-to-one
/// @return   whether a follows the guide now
bool follow_on_disk(const Guide& guide, MappedPart& a, const Shape& shape_b, const MappedPart& b,
                    Report& report);

/// Points of part a and where a dense alignment says they belong on b: for align_spheres. What lies far from
/// its place, in diagonals of b's box, counts little.
SurfaceMatches guided_matches(const Guide& guide, const Shape& shape_a, const MappedPart& a,
                              const Shape& shape_b, const MappedPart& b);

/// As follow_on_disk, on the sphere, where such a repair need not end well: starting from a's own map,
/// vertices go to their places as far as no triangle turns over (MovableMap), so that the result is always
/// one-to-one.
/// @param a  mapped and aligned with b; the nearer it is to the places, the more of them are reached
void follow_on_sphere(const Guide& guide, const Shape& shape_a, MappedPart& a, const Shape& shape_b,
                      const MappedPart& b, Report& report);

}  // namespace automorph
