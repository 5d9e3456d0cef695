#pragma once

#include <optional>

#include "morph/alignment/guide.h"
#include "morph/merge_maps.h"
#include "morph/parameterization/guided_map.h"

namespace automorph {

/// Rays where an alignment puts the vertices of part a: the images of their places on part b, whose map is
/// known.
/// @param guide  of the whole shapes
/// @returns #V of a x 3, unit vectors on the sphere; border vertices have the rays of `a`
Points guided_places(const MappedPart& a, const Guide& guide, const MappedPart& b, MapDomain domain);

/// The map of a onto the disk that follows the guide on b's map; adds to report.alignment how. Empty where no
/// one-to-one map was found so. On the sphere there is no such repair that is sure to end well: see
/// MovableMap::follow.
/// @param a  rays of border vertices are set
std::optional<Points> follow_guide(const MappedPart& a, const Guide& guide, const MappedPart& b,
                                   Report& report);

}  // namespace automorph
