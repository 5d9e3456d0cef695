#pragma once

#include "morph/alignment/guide.h"
#include "morph/merge_maps.h"
#include "morph/parameterization/guided_map.h"

namespace automorph {

/// Gives part a the map that puts its vertices where a dense alignment says they belong on b, made one-to-one
/// (guided_map); the loop keeps its rays. Says in the report what it took.
/// @param a  a whole shape, mapped; keeps its map where the guided one cannot be made one-to-one
/// @return   whether a follows the guide now
bool follow(const Guide& guide, MappedPart& a, const Shape& shape_b, const MappedPart& b, MapDomain domain,
            Report& report);

}  // namespace automorph
