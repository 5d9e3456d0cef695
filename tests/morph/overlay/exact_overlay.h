#pragma once

#include <string>
#include <vector>

#include "morph/overlay/overlay.h"
#include "test_maps.h"

namespace automorph::testing {

/// The overlay by brute force in rational arithmetic: every triangle of a is clipped against every triangle
/// of b, and corners are the same vertex where they are the same rational direction. Quadratic; shares no
/// code and no idea with the walk of morph/overlay. Weights are exact values rounded to double.
/// @throws std::logic_error if two rational directions have one place in the meshes or the reverse: a map is
/// not
///         one-to-one
Overlay exact_overlay(const TestMap& a, const TestMap& b);

/// Compares the combinatorics: counts, vertices as pairs of places in the meshes, faces as (face of a, face
/// of b, cycle of corners up to its start); and the weights to kWeightTolerance relative. Empty if they
/// agree, else the first few differences.
std::string difference(const Overlay& found, const Overlay& expected);

/// Relative: morph/exact/determinant promises 1e-12, a weight is a ratio of two determinants or of sums of
/// them.
constexpr double kWeightTolerance = 1e-11;

}  // namespace automorph::testing
